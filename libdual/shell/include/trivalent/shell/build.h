#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trivalent/dual/hydrogen.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/dual/walls.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/potentials/relax.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/tube_ends.h"
#include "trivalent/shell/build_shell.h"
#include "trivalent/shell/energy_budget.h"
#include "trivalent/shell/json.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/relax_report.h"
#include "trivalent/shell/surface_source.h"
#include "trivalent/view/shell_state.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// What is done at the edge of an open shell.
enum class EdgeCap {
  none,
  hydrogen,  ///< puts H on atoms with fewer than three bonds
};

enum class Relaxation {
  none,     ///< the atoms stay where the dual puts them
  at_rest,  ///< they are brought to rest under the potential
};

/// The steps of a build, in their order.
enum class BuildStep { remesh_and_dual, measure, energies, relax };

struct BuildOptions {
  dual::ShellOptions shell = {};  ///< size, bond and method; how remeshing is followed and stopped
  EdgeCap cap = EdgeCap::none;
  /// If empty, REBO, or AIREBO for several walls, which REBO does not hold apart.
  std::optional<PotentialChoice> potential = {};
  /// The potential, or the one that is taken if it is empty.
  [[nodiscard]] PotentialChoice used_potential() const {
    return potential.value_or(PotentialChoice{.name = shell.walls.count > 1 ? "airebo" : "rebo"});
  }
  Relaxation relaxation = Relaxation::at_rest;
  potentials::BoxPolicy box = potentials::BoxPolicy::pressure_free;  ///< of a periodic shell
  /// A shell that is not at rest by then is caught somewhere: relax() can go on.
  int max_relaxation_steps = 3000;
  std::function<void(BuildStep)> on_step = {};  ///< before each step
  /// After each step of the relaxation; returns false to stop there.
  std::function<bool(const potentials::RelaxProgress&)> on_relax = {};
};

/// Everything known about a shell that was built; lengths in Å.
struct BuildResult {
  std::vector<std::string> notes = {};  ///< what was found on the way, for people
  double wrap_offset = 0.0;             ///< distance from the input to its wrap; 0 without one
  remesh::MeshQuality input_quality = {};
  remesh::TriMesh original = {};  ///< the input surface at the shell's scale
  dual::Shell shell = {};
  remesh::MeshQuality quality = {};
  remesh::MeshComponents components = {};  ///< of_face also covers hydrogens
  /// Of the net, before the shell is relaxed; of several, that of the given surface.
  remesh::TwoSidedDistance distance = {};
  /// Of the net carried along by the atoms that were relaxed; none if that was stopped.
  std::optional<remesh::TwoSidedDistance> distance_at_rest = {};
  dual::NetworkReport network = {};  ///< of the carbon atoms, as they are in the end
  /// What tube each open end of the net is that of; none where it is no tube's.
  std::vector<std::optional<remesh::ChiralIndices>> tube_ends = {};
  dual::HydrogenCaps caps = {};
  PotentialChoice potential = {};
  double graphene = 0.0;  ///< an atom's energy in graphene under the potential [eV]
  potentials::EnergyForces energy = {};
  std::vector<dual::WallReport> walls = {};  ///< if there are several
  /// What each atom's energy is lower for by the other walls [eV]; empty if there is one.
  std::vector<double> wall_energies = {};
  std::optional<dual::ShellState> before =
      {};  ///< the dual of the input, if it has an energy; none if stopped, or of several walls
  std::optional<dual::ShellState> unrelaxed = {};  ///< the shell before it was relaxed
  std::optional<potentials::RelaxResult> relaxed = {};
  RelaxReport relaxation = {};
  dual::ShellState after = {};  ///< the shell
  EnergyBudget budget = {};     ///< of its energy
  bool stopped = false;         ///< a step ended early because that was asked for
  std::vector<std::pair<std::string, double>> seconds = {};  ///< of every step

  /// The shell's atoms as files hold them: rings, components, energies, forces, displacements.
  [[nodiscard]] dual::Structure structure() const;
  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Turns a surface into a carbon shell: remeshes it, takes the dual, caps, measures and relaxes it.
///
/// @throws remesh::InvalidMesh        if plan() finds an obstacle
/// @throws remesh::InvalidOption, dual::InvalidOption if an option is out of its range
/// @throws dual::InvalidNetwork       if the net has no dual
/// @throws potentials::InvalidAtoms   if the shell meets itself
[[nodiscard]] BuildResult build(Surface surface, const BuildOptions& options = {});

/// What to say of a net that was stopped early.
[[nodiscard]] std::string stopped_note(const remesh::RemeshResult& net);

}  // namespace trivalent::shell
