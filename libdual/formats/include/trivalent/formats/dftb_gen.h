#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads the .gen format of DFTB+: cluster (C), supercell with Cartesian (S) or fractional (F)
/// positions. A supercell is periodic in all directions.
///
/// @throws FileError      if the file is missing or malformed; the message names the line.
/// @throws InvalidOption  if the options ask for another frame than 1, or an atom_style.
[[nodiscard]] StructureFile read_dftb_gen(const std::filesystem::path& path,
                                          const ReadOptions& options = {});

/// Writes C for free atoms, S for others. There are no bonds.
///
/// @return  Notes on what changed: the cell, periodic directions.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite.
std::vector<std::string> write_dftb_gen(std::ostream& out, const Structure& structure,
                                        const WriteOptions& options = {});

}  // namespace trivalent::dual
