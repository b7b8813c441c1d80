#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/dual/lammps_data.h"

namespace trivalent::dual {

/// What an input script needs to know about the data.
struct LammpsDeckOptions {
  /// As read_data finds them; further ones are parts, added to the first. Must be set.
  std::vector<std::string> data_files = {};
  AtomStyle style = AtomStyle::atomic;
  bool angles = false;  ///< the data file has them
  std::array<bool, 3> periodic = {false, false, false};
  bool has_hydrogen = false;
  std::string potential_file = "CH.rebo";  ///< `lmp -var potential FILE` overrides it
  /// Total of the data under REBO [eV]; LAMMPS must find it to 1e-8 eV per atom and 1e-9 of its
  /// size.
  std::optional<double> expected_energy = {};
};

// LAMMPS input scripts [LAMMPS], all with `pair_style rebo`.
// @throws InvalidOption if there is no data file, or the name of a file is empty or has a blank,
//   quote, '$', '&', '#' or control character.

/// Computes the energies per atom once, prints total and mean with 15 digits, and ends with status
/// 1 if the total is not the expected.
void write_lammps_check(std::ostream& out, const LammpsDeckOptions& options);

/// Minimizes until no force is above 1e-3 eV/Å and writes the result as relaxed.data.
void write_lammps_relaxation(std::ostream& out, const LammpsDeckOptions& options);

/// Warms up, then follows the atoms at constant energy; prints the drift of the energy and how many
/// neighbors the atoms have in the end. Writes md.dump and restart files.
void write_lammps_dynamics(std::ostream& out, const LammpsDeckOptions& options);

}  // namespace trivalent::dual
