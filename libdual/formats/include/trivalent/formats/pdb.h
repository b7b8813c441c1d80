#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Reads ATOM, HETATM, CRYST1, CONECT and MODEL records of a PDB file [PDB33]. A cell is periodic
/// in all directions; the unit cube of CRYST1 stands for none. Bonds lead to the nearest image.
/// Serial numbers may be of any kind (decimal, hybrid-36): they only have to be different where
/// CONECT names them.
///
/// @throws FileError      if the file is missing or malformed, or lacks the wanted structure; the
///   message names the line.
/// @throws InvalidOption  if the options name an atom_style.
[[nodiscard]] StructureFile read_pdb(const std::filesystem::path& path,
                                     const ReadOptions& options = {});

/// Writes HETATM records of a residue UNL, CRYST1 for periodic atoms, and CONECT for the bonds that
/// are known, up to 99,999 atoms. Positions have 3 decimals [Å]. Serial numbers above 99,999 are
/// hybrid-36 (A0000,
/// ...), as cctbx, gemmi and VMD read them.
///
/// @return  Notes on what changed: the cell, periodic directions, bonds to images, decimals.
/// @throws InvalidOption, InvalidNetwork  if the cell is flat, or a coordinate is not finite or has
///   too many digits for its column.
std::vector<std::string> write_pdb(std::ostream& out, const Structure& structure,
                                   const WriteOptions& options = {});

}  // namespace trivalent::dual
