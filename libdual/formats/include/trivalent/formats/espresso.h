#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads the cards ATOMIC_POSITIONS and CELL_PARAMETERS of an input of Quantum ESPRESSO's pw.x, in
/// angstrom, bohr, crystal or alat (with celldm(1) or A). The cell is periodic in all directions.
/// Flags after the positions become the column `selective_dynamics`.
///
/// @throws FileError      if the file is missing or malformed, or its cell is given by another
///   ibrav than 0; the message names the line.
/// @throws InvalidOption  if the options ask for another frame than 1, or an atom_style.
[[nodiscard]] StructureFile read_espresso(const std::filesystem::path& path,
                                          const ReadOptions& options = {});

/// Writes an input of pw.x that relaxes the atoms: PBE, 40 Ry, pseudopotentials of pslibrary in the
/// folder of the run, only Γ. Free atoms get a cell with room.
///
/// @return  Notes on what changed: the cell, periodic directions.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite.
std::vector<std::string> write_espresso(std::ostream& out, const Structure& structure,
                                        const WriteOptions& options = {});

}  // namespace trivalent::dual
