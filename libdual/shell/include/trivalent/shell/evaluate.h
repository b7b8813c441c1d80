#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/structure.h"
#include "trivalent/dual/walls.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/shell/json.h"
#include "trivalent/shell/lammps_run.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/reports.h"
#include "trivalent/view/shell_state.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

enum class ForceReport { none, all };

struct EvaluateOptions {
  PotentialChoice potential = {};
  /// Have LAMMPS compute instead of us; its potential is set by evaluate().
  std::optional<LammpsOptions> lammps = {};
  int n_worst = 5;  ///< atoms of highest energy in the report, >= 0
  ForceReport forces = ForceReport::none;
};

/// Energies and forces of a structure, and what it looks like with them.
struct Evaluation {
  std::string potential = {};
  dual::ShellState state = {};
  potentials::EnergyForces energy = {};
  dual::EnergySummary summary = {};
  std::vector<dual::WallReport> walls = {};  ///< if there are several
  /// What each atom's energy is lower for by the other walls [eV]; empty if there is one, or LAMMPS
  /// computes.
  std::vector<double> wall_energies = {};
  ForceReport forces = ForceReport::none;  ///< in json(), rows() and structure()
  BondSource bonds = BondSource::file;

  /// The structure with coordinations, rings, energies and, if they are reported, forces; bonds are
  /// only in it if they are known.
  [[nodiscard]] dual::Structure structure() const;
  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Evaluates a potential; bonds and rings are found where they are not known.
///
/// @throws dual::InvalidOption, potentials::InvalidOption if an option is out of its range
/// @throws potentials::InvalidAtoms if the potential has no energy for the atoms
/// @throws what run_lammps throws
[[nodiscard]] Evaluation evaluate(dual::Structure structure, const EvaluateOptions& options = {});

}  // namespace trivalent::shell
