#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/formats/lammps_deck.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::shell {

/// How the installed LAMMPS is run.
struct LammpsOptions {
  int ranks = 1;  ///< MPI processes, >= 1
  dual::LammpsPotential potential = dual::LammpsPotential::rebo;
  std::optional<dual::PairStyle> pair_style = {};  ///< instead of the potential
  /// CH.rebo or CH.airebo; none: LAMMPS finds it.
  std::optional<std::filesystem::path> potential_file = {};
};

/// What LAMMPS says while it works.
struct LammpsProgress {
  int step = 0;
  double energy = 0.0;                   ///< [eV]
  double largest_force_component = 0.0;  ///< [eV/Å]
};

struct LammpsTask {
  std::string style = "cg";               ///< LAMMPS's min_style
  double max_force = 1e-3;                ///< [eV/Å]
  int max_steps = 0;                      ///< 0: only energies and forces
  std::vector<std::uint32_t> fixed = {};  ///< atoms that stay, ascending
  bool relax_box = false;
  /// How the name of the folder begins in which LAMMPS works; the folder is removed afterwards,
  /// unless something went wrong. None: in the folder for temporary files.
  std::optional<std::filesystem::path> folder = {};
  std::function<void(const LammpsProgress&)> on_progress = {};
};

/// Refuses, before any work, what LAMMPS could not do.
///
/// @throws dual::InvalidOption if an option is out of its range
/// @throws dual::Error if lmp or mpirun is needed and not installed
void require_lammps(const LammpsOptions& options);

/// Whether the installed `lmp` was built with a pair style, whose arguments are not looked at;
/// false if it is not installed.
[[nodiscard]] bool has_pair_style(const std::string& style);

/// A potential's file as input scripts name it.
struct LammpsPotentialFile {
  std::string name;  ///< an absolute path, or the bare name of the file that comes with LAMMPS
  std::optional<std::string> warning = {};  ///< if LAMMPS will not find it on this machine
};

/// @throws dual::InvalidOption if the named file does not exist.
[[nodiscard]] LammpsPotentialFile find_potential_file(const LammpsOptions& options);

/// Has the installed `lmp` evaluate or minimize atoms, under `mpirun` if there are several ranks,
/// and reads the result back. The result has no virial.
///
/// @throws dual::InvalidOption, dual::InvalidNetwork as write_lammps_data
/// @throws dual::Error with LAMMPS's own message if it fails
[[nodiscard]] potentials::RelaxResult run_lammps(const potentials::Atoms& atoms,
                                                 const LammpsTask& task,
                                                 const LammpsOptions& options = {});

}  // namespace trivalent::shell
