#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads a structure of GROMACS's .gro format [nm], with any number of decimals. Elements are the
/// first letter of the atoms' names. A box without size is none; any other is periodic in all
/// directions. Velocities are left out.
///
/// @throws FileError      if the file is missing or malformed, or lacks the wanted structure; the
///   message names the line.
/// @throws InvalidOption  if the options name an atom_style.
[[nodiscard]] StructureFile read_gro(const std::filesystem::path& path,
                                     const ReadOptions& options = {});

/// Writes .gro with 3 decimals [nm], 0.01 Å, as all programs read it; with 10 decimals if all
/// digits are asked for, which GROMACS reads. Numbers of atoms above 99,999 begin again at 0, as
/// GROMACS writes them. There are no bonds.
///
/// @return  Notes on what changed: the cell, periodic directions, decimals.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite or has
///   too many digits for its column.
std::vector<std::string> write_gro(std::ostream& out, const Structure& structure,
                                   const WriteOptions& options = {});

}  // namespace trivalent::dual
