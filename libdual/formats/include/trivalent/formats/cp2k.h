#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads &COORD and &CELL of an input of CP2K: positions in angstrom, in bohr (UNIT) or SCALED; the
/// cell as A, B, C or as ABC with ALPHA_BETA_GAMMA; PERIODIC.
///
/// @throws FileError      if the file is missing or malformed, or @INCLUDEs another; the message
///   names the line.
/// @throws InvalidOption  if the options ask for another frame than 1, or an atom_style.
[[nodiscard]] StructureFile read_cp2k(const std::filesystem::path& path,
                                      const ReadOptions& options = {});

/// Writes an input of CP2K that relaxes the atoms under GFN1-xTB, which needs no files but those
/// that come with CP2K. Free atoms stay free; of partly periodic ones all directions become
/// periodic.
///
/// @return  Notes on what changed: the cell.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite.
std::vector<std::string> write_cp2k(std::ostream& out, const Structure& structure,
                                    const WriteOptions& options = {});

}  // namespace trivalent::dual
