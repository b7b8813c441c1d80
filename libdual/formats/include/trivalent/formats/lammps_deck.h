#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/formats/lammps_data.h"

namespace trivalent::dual {

/// What LAMMPS calls pair_style.
enum class LammpsPotential {
  rebo,   ///< second-generation REBO
  airebo  ///< `airebo 3.0 1 1`: with Lennard-Jones and torsion terms
};

/// The file of parameters that LAMMPS brings for it.
[[nodiscard]] std::string file_name_of(LammpsPotential potential);

/// Any other potential of LAMMPS, in its own words.
struct PairStyle {
  std::string style;                      ///< arguments of pair_style, as in "tersoff"
  std::vector<std::string> coefficients;  ///< of each pair_coeff, as in "* * BNC.tersoff C"
};

/// What an input script needs to know about the data.
struct LammpsDeckOptions {
  /// As read_data finds them; further ones are parts, added to the first. Must be set.
  std::vector<std::string> data_files = {};
  AtomStyle style = AtomStyle::atomic;
  bool angles = false;  ///< the data file has them
  std::array<bool, 3> periodic = {false, false, false};
  bool has_hydrogen = false;
  LammpsPotential potential = LammpsPotential::rebo;
  std::string potential_file = "CH.rebo";    ///< `lmp -var potential FILE` overrides it
  std::optional<PairStyle> pair_style = {};  ///< instead of the potential and its file
  /// Total of the data under the potential [eV]; LAMMPS must find it to 1e-8 eV per atom and 1e-9
  /// of its size.
  std::optional<double> expected_energy = {};
};

/// A minimization that LAMMPS is to do for us.
struct LammpsMinimization {
  std::string style = "cg";               ///< LAMMPS's min_style
  double max_force = 1e-3;                ///< [eV/Å], > 0: done once no atom has a larger force
  int max_steps = 20000;                  ///< >= 0; 0: only energies and forces
  std::vector<std::uint32_t> fixed = {};  ///< atoms that stay, from 0, ascending
  bool relax_box = false;  ///< the periodic cell vectors too, until no stress is left
  bool has_tilts = false;  ///< the box is triclinic
  int ranks = 1;           ///< >= 1; several get as many atoms each, also of a hollow shell
};

// LAMMPS input scripts [LAMMPS].
// @throws InvalidOption if there is no data file, or the name of a file is empty or has a blank,
//   quote, '$', '&', '#' or control character, or an argument of the pair style has one of these
//   but blanks.

/// Computes the energies per atom once, prints total and mean with 15 digits, and ends with status
/// 1 if the total is not the expected.
void write_lammps_check(std::ostream& out, const LammpsDeckOptions& options);

/// Minimizes until no force is above 1e-3 eV/Å and writes the result as relaxed.data.
void write_lammps_relaxation(std::ostream& out, const LammpsDeckOptions& options);

/// Warms up, then follows the atoms at constant energy; prints the drift of the energy and how many
/// neighbors the atoms have in the end. Writes md.dump and restart files.
void write_lammps_dynamics(std::ostream& out, const LammpsDeckOptions& options);

/// Minimizes and hands the result over: the file result.dump has `id x y z fx fy fz energy` of all
/// atoms in order, with every bit, positions not wrapped into the box; a line "box xlo ylo zlo xhi
/// yhi zhi xy xz yz" is printed. Thermodynamic output is "step energy largest-force-component".
void write_lammps_minimization(std::ostream& out, const LammpsDeckOptions& options,
                               const LammpsMinimization& minimization);

}  // namespace trivalent::dual
