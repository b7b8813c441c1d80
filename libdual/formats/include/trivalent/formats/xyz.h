#pragma once

#include <filesystem>
#include <iosfwd>

#include "trivalent/dual/error.h"
#include "trivalent/dual/structure.h"
#include "trivalent/formats/digits.h"
#include "trivalent/formats/structure_file.h"
#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Writes extended XYZ: Lattice, Properties and pbc, then `species pos` and the columns. Bonds, if
/// they are known, come last, as bonded_atoms (indices from 0, -1 where there is none) and, in a
/// periodic box, bonded_images (three cell vectors each). Atoms that are periodic in no direction
/// and have no box get a padded one.
///
/// @throws InvalidNetwork if a coordinate is not finite, or species or a column does not have one
///   entry per atom.
/// @throws InvalidOption  if a name is empty, has other characters, or is taken.
void write_xyz(std::ostream& out, const Structure& structure, Digits digits = Digits::ten_decimals);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_xyz(const std::filesystem::path& path, const Structure& structure,
               Digits digits = Digits::ten_decimals);

/// Reads a structure of an XYZ or extended XYZ file [extxyz], also compressed with gzip, also from
/// standard input ("-").
///
/// Keys of the structure (Lattice, Origin, Properties, pbc) may be in any case; without pbc a
/// Lattice is periodic in all directions; without Lattice there is no box. Elements are symbols,
/// atomic numbers, or LAMMPS's types of which the options name the elements. The columns
/// bonded_atoms and bonded_images, which write_xyz() writes, become bonds. Columns of text or
/// booleans, or of other than 1 or 3 components, are left out and noted.
///
/// @throws FileError if the file is missing, unreadable, cut short or malformed, lacks the wanted
///   structure, holds a number that is not finite, a key that seems to be a misspelled one of the
///   structure, or elements other than C and H; the message names the line.
/// @throws InvalidOption if the options name an atom_style.
[[nodiscard]] StructureFile read_xyz(const std::filesystem::path& path,
                                     const ReadOptions& options = {});

}  // namespace trivalent::dual
