#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/potentials/relax.h"
#include "trivalent/shell/json.h"
#include "trivalent/shell/lammps_run.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/relax_report.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// Structures on the way, as extended XYZ.
struct TrajectoryOptions {
  std::filesystem::path path;  ///< has the name with .part added until it is complete
  int every = 10;              ///< steps from one structure to the next, >= 1
};

/// LAMMPS's min_styles.
inline constexpr std::array<std::string_view, 5> lammps_minimizers = {"cg", "fire", "hftn",
                                                                      "quickmin", "sd"};

/// Lets LAMMPS relax instead of our own minimizers. It has no gentle start: bonds may break.
struct LammpsRelaxation {
  LammpsOptions run = {};                            ///< its potential is set by relax()
  std::string style = "cg";                          ///< one of lammps_minimizers
  std::optional<std::filesystem::path> folder = {};  ///< as LammpsTask::folder
  std::function<void(const LammpsProgress&)> on_progress = {};
};

struct RelaxOptions {
  PotentialChoice potential = {};
  potentials::Minimizer minimizer = potentials::Minimizer::lbfgs;
  double max_force = potentials::RelaxOptions().max_force;          ///< [eV/Å], > 0
  double energy_change = potentials::RelaxOptions().energy_change;  ///< [eV per atom], >= 0
  int max_steps = potentials::RelaxOptions().max_steps;             ///< >= 1
  potentials::BoxPolicy box = potentials::BoxPolicy::fixed;
  std::vector<std::string> fixed = {};  ///< groups of atoms that stay, as atoms_in_groups()
  std::optional<LammpsRelaxation> lammps = {};
  std::optional<TrajectoryOptions> trajectory = {};  ///< own minimizers only
  /// File from which a run that was killed goes on when it is started again; to be removed once the
  /// result is safe. None: no checkpoints. Own minimizers only.
  std::optional<std::filesystem::path> checkpoint = {};
  int checkpoint_every = potentials::RelaxOptions().checkpoint_every;  ///< steps, >= 1
  /// After each step; returns false to stop there. Own minimizers only.
  std::function<bool(const potentials::RelaxProgress&)> on_progress = {};
  std::function<void(const std::string&)> on_note = {};  ///< what is known before the first step
};

struct RelaxedStructure {
  dual::Structure structure = {};  ///< at rest, with energies, forces and displacements
  std::string potential = {};
  potentials::RelaxResult relaxed = {};
  RelaxReport report = {};
  bool stopped = false;                 ///< by on_progress
  std::vector<std::string> notes = {};  ///< one sentence for each thing that is not as it should be

  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Brings the atoms of a structure to rest.
///
/// @throws dual::InvalidOption, potentials::InvalidOption if an option is out of its range
/// @throws potentials::InvalidAtoms as potentials::relax
/// @throws what run_lammps throws; dual::FileError if a file on the way cannot be written
[[nodiscard]] RelaxedStructure relax(dual::Structure structure, const RelaxOptions& options = {});

}  // namespace trivalent::shell
