#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/dual/digits.h"
#include "trivalent/dual/error.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// LAMMPS's atom_style: which columns the section Atoms has.
enum class AtomStyle {
  atomic,    ///< id type x y z
  molecular  ///< id molecule type x y z, and a section Bonds
};

/// What a LAMMPS data file holds for us.
struct LammpsData {
  potentials::Atoms atoms;
  std::vector<std::array<int, 2>> bonds = {};  ///< atom indices from 0
  std::vector<std::string> notes = {};         ///< reading: one sentence per kind of thing left out
};

struct LammpsDataOptions {
  AtomStyle style = AtomStyle::atomic;  ///< atomic leaves the bonds out
  Digits digits = Digits::ten_decimals;
  std::string title =
      "carbon shell";  ///< first line of the file [at most 200 characters, one line]
};

/// Writes a data file [LAMMPS]: ids are 1 to n in order, C is type 1 and H type 2 (if there are
/// any). Atoms that are periodic in no direction and have no box get a padded one.
///
/// @throws InvalidNetwork if a coordinate is not finite, species are not one per atom, or a bond
/// names an
///   atom that does not exist.
/// @throws InvalidOption  if the box's cell is not LAMMPS's (a along x, b in the xy plane, a
/// right-handed
///   cell, tilts of at most half a side), or the title is too long or not one line.
void write_lammps_data(std::ostream& out, const LammpsData& data,
                       const LammpsDataOptions& options = {});

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_lammps_data(const std::filesystem::path& path, const LammpsData& data,
                       const LammpsDataOptions& options = {});

/// Reads a data file of atom_style atomic, charge, molecular or full, also compressed with gzip.
/// Elements come from the masses. Atoms are ordered by id; velocities and everything about force
/// fields is left out and noted. A data file does not say which directions are periodic: the box is
/// taken as periodic in all three, as LAMMPS does unless it is told otherwise.
///
/// @throws FileError if the file is missing, unreadable, cut short or malformed, has another
/// atom_style,
///   masses of other elements than C and H, or atoms twice; the message names the line.
[[nodiscard]] LammpsData read_lammps_data(const std::filesystem::path& path);

/// What the check deck needs to know about the data file.
struct LammpsCheckOptions {
  std::string data_file;  ///< as read_data finds it; must be set by the caller
  AtomStyle style = AtomStyle::atomic;
  std::array<bool, 3> periodic = {false, false, false};
  bool has_hydrogen = false;
  std::string potential_file = "CH.rebo";  ///< `lmp -var potential FILE` overrides it
  /// Total [eV]; LAMMPS must find it to 1e-8 eV per atom and 1e-9 of its size.
  std::optional<double> expected_energy = {};
};

/// Writes a LAMMPS input script that reads the data file, computes `pair_style rebo` energies per
/// atom once, prints total and mean with 15 digits, and ends with status 1 if the total is not the
/// expected.
///
/// @throws InvalidOption if a file name is empty or has a blank, quote, '$', '&', '#' or control
/// character.
void write_lammps_check(std::ostream& out, const LammpsCheckOptions& options);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_lammps_check(const std::filesystem::path& path, const LammpsCheckOptions& options);

}  // namespace trivalent::dual
