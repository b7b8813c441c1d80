#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads a molecule of a Tripos MOL2 file: atoms, bonds, and the cell of CRYSIN, periodic in all
/// directions. Elements are the types up to their dot (C.ar). Bonds lead to the nearest image.
///
/// @throws FileError      if the file is missing or malformed, or lacks the wanted structure; the
///   message names the line.
/// @throws InvalidOption  if the options name an atom_style.
[[nodiscard]] StructureFile read_mol2(const std::filesystem::path& path,
                                      const ReadOptions& options = {});

/// Writes a molecule with the bonds that are known. Types of carbon follow its bonds: C.3 with
/// four, C.ar with three, C.1 with two; bonds of C.ar are aromatic. CRYSIN is written for periodic
/// atoms.
///
/// @return  Notes on what changed: the cell, periodic directions, bonds to images.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite.
std::vector<std::string> write_mol2(std::ostream& out, const Structure& structure,
                                    const WriteOptions& options = {});

}  // namespace trivalent::dual
