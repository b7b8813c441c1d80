#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads a block with atoms of a CIF [Hall1991], or of an mmCIF file, by [Wojdyr2022]. Every site
/// is repeated by the symmetry operations of the file, or else by those of the space group it
/// names; copies within 0.05 Å of each other are one atom. The cell is periodic in all directions,
/// a along x, b in the xy plane. The list of bonds (_geom_bond) is used if the file has no symmetry
/// but the identity.
///
/// @throws FileError      if the file is missing or malformed, has no or partly occupied sites,
/// lacks
///   the wanted structure, or names an unknown space group; the message names the site or item.
/// @throws InvalidOption  if the options name an atom_style.
[[nodiscard]] StructureFile read_cif(const std::filesystem::path& path,
                                     const ReadOptions& options = {});

/// Writes a CIF: all atoms in P 1 with the bonds that are known, or, if the options have a symmetry
/// tolerance, the conventional cell of the space group that spglib [Togo2018] finds, with one atom
/// of each kind. Free atoms get a cell with room.
///
/// @return  Notes on what changed: the cell, periodic directions, bonds.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, a coordinate is not finite, or no
///   space group is found.
std::vector<std::string> write_cif(std::ostream& out, const Structure& structure,
                                   const WriteOptions& options = {});

/// Writes the atoms of an mmCIF file (_atom_site of the PDBx/mmCIF dictionary) as one residue UNL
/// in Å, with the cell of periodic atoms in P 1. Unlike PDB it has no limits on numbers and digits.
///
/// @return  Notes on what changed: the cell, periodic directions, bonds.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite.
std::vector<std::string> write_mmcif(std::ostream& out, const Structure& structure,
                                     const WriteOptions& options = {});

}  // namespace trivalent::dual
