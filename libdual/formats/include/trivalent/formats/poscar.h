#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads VASP's POSCAR or CONTCAR: scale or volume, Direct or Cartesian positions. Flags of
/// "Selective dynamics" become the column `selective_dynamics`. Files of VASP 4 lack the elements;
/// the options then name them. Velocities are left out.
///
/// @throws FileError      if the file is missing or malformed; the message names the line.
/// @throws InvalidOption  if the options ask for another frame than 1, or an atom_style.
[[nodiscard]] StructureFile read_poscar(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

/// Writes a POSCAR of VASP 5 with Direct positions, carbon first. It has no bonds and no free
/// directions.
///
/// @return  Notes on what changed: order, cell, periodic directions.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite.
std::vector<std::string> write_poscar(std::ostream& out, const Structure& structure,
                                      const WriteOptions& options = {});

}  // namespace trivalent::dual
