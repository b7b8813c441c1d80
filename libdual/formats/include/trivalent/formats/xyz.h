#pragma once

#include <filesystem>
#include <iosfwd>

#include "trivalent/dual/error.h"
#include "trivalent/dual/structure.h"
#include "trivalent/formats/digits.h"
#include "trivalent/formats/structure_file.h"

namespace trivalent::dual {

/// Writes extended XYZ: Lattice, Properties and pbc, then `species pos` and the columns. Atoms that
/// are periodic in no direction and have no box get a padded one.
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

/// Reads the first structure of an XYZ or extended XYZ file, also compressed with gzip. Columns of
/// text, or of other than 1 or 3 components, are left out and noted, as are further structures.
/// Without pbc a Lattice is periodic in all directions; without Lattice there is no box.
///
/// @throws FileError if the file is missing, unreadable, cut short or malformed, holds a number
/// that
///   is not finite, or elements other than C and H; the message names the line.
[[nodiscard]] StructureFile read_xyz(const std::filesystem::path& path);

}  // namespace trivalent::dual
