#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/dual/error.h"
#include "trivalent/dual/structure.h"
#include "trivalent/formats/digits.h"
#include "trivalent/formats/structure_file.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Atoms [begin, end).
struct AtomRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct LammpsDataOptions {
  AtomStyle style = AtomStyle::atomic;  ///< atomic (leaves the bonds out) or molecular
  bool angles = false;                  ///< molecular style: also all pairs of bonds at an atom
  Digits digits = Digits::ten_decimals;
  std::string title =
      "carbon shell";  ///< first line of the file [at most 200 characters, one line]
  /// Only these atoms, for files that `read_data ... add merge` joins; atomic style only.
  std::optional<AtomRange> part = {};
};

/// LAMMPS as distributions build it counts atoms with 32 bits.
inline constexpr std::uint64_t max_lammps_atoms = 2147483647;

/// @throws InvalidNetwork if there are more atoms than that.
void require_lammps_ids(std::uint64_t atoms);

/// Writes a data file [LAMMPS]: ids are 1 to n in order, C is type 1 and H type 2 (if there are
/// any). In molecular style every wall is a molecule. Atoms that are periodic in no direction and
/// have no box get a padded one.
///
/// @throws InvalidNetwork if a coordinate is not finite, species are not one per atom, a bond names
///   an atom that does not exist, or there are too many atoms.
/// @throws InvalidOption  if the box does not fit LAMMPS (see lammps_frame.h), the style is read
///   only, the title is too long or not one line, or a part is not one of the atoms or asked for in
///   molecular style.
void write_lammps_data(std::ostream& out, const Structure& structure,
                       const LammpsDataOptions& options = {});

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_lammps_data(const std::filesystem::path& path, const Structure& structure,
                       const LammpsDataOptions& options = {});

/// Reads a data file of atom_style atomic, charge, bond, angle, molecular or full, also compressed
/// with gzip, also from standard input ("-").
///
/// Elements come from the options, the masses or the type labels; a single type without any is
/// carbon, which is noted. Atoms are ordered by id; velocities and everything about force fields is
/// left out and noted. A data file does not say which directions are periodic: the box is taken as
/// periodic in all three, as LAMMPS does unless it is told otherwise. Bonds lead to the nearest
/// periodic image.
///
/// @throws FileError if the file is missing, unreadable, cut short or malformed, has a line in its
///   header that LAMMPS does not know, another atom_style or one that cannot be told, other units
///   than metal or real in its title, a mass that contradicts its comment or label, masses of other
///   elements than C and H, or atoms twice; the message names the line.
/// @throws InvalidOption if the options name another structure than the first.
[[nodiscard]] StructureFile read_lammps_data(const std::filesystem::path& path,
                                             const ReadOptions& options = {});

}  // namespace trivalent::dual
