#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/potentials/potential.h"

namespace trivalent::potentials {

enum class Minimizer {
  fire,   ///< damped dynamics [Bitzek2006]
  lbfgs,  ///< limited-memory quasi-Newton with line search [Nocedal2006]
};

enum class BoxPolicy {
  fixed,         ///< the cell stays
  pressure_free  ///< the periodic cell vectors are relaxed too, until no stress is left
};

/// What the atoms are relaxed under.
enum class RelaxStage {
  springs,  ///< springs along the bonds of the network, which cannot tear
  guarded,  ///< the potential, and springs on bonds that become too long or too short
  free,     ///< the potential
  held      ///< the potential, and springs on bonds that want to tear
};

/// Where a relaxation begins.
enum class RelaxStart {
  gentle,  ///< with springs, if a bond of the network is far from carbon's; then guarded
  direct   ///< under the potential
};

/// How far a relaxation has come.
struct RelaxProgress {
  RelaxStage stage;
  int steps;             ///< of all stages
  int evaluations;       ///< of energy and forces
  double energy;         ///< of the potential and of springs [eV]
  double largest_force;  ///< on an atom that may move [eV/Å]
  const Atoms& atoms;    ///< as they are now
};

/// Where a relaxation under the potential can be taken up again: the same as if it had gone on.
struct RelaxCheckpoint {
  int steps;
  int evaluations;
  const Atoms& atoms;
};

struct RelaxOptions {
  Minimizer minimizer = Minimizer::lbfgs;
  double max_force = 1e-3;  ///< [eV/Å], > 0: converged once no atom has more
  double energy_change =
      0.0;  ///< [eV per atom], >= 0: also once ten steps together bring less; 0: never
  int max_steps = 20000;  ///< >= 0, of all stages
  double max_move = 0.1;  ///< [Å], > 0: no atom goes farther in one step
  RelaxStart start = RelaxStart::gentle;
  BoxPolicy box = BoxPolicy::fixed;
  std::vector<std::uint32_t> fixed = {};  ///< atoms that stay
  std::vector<Bond> bonds = {};  ///< of the network, if it is known: no step under the potential
                                 ///< stretches one beyond bond_limit
  double bond_limit = 1.95;      ///< [Å]; a bond that starts longer may only shorten
  int first_step = 0;            ///< >= 0: taken before, where a relaxation is taken up again
  int first_evaluation = 0;      ///< likewise
  int checkpoint_every =
      200;  ///< steps under the potential, >= 1: the minimizer then starts afresh
  /// Before the first step of each start under the potential. For bit-identical resumption, the
  /// potential must forget() here.
  std::function<void(const RelaxCheckpoint&)> on_checkpoint = {};
  /// Before the first step and after each; returns false to stop there.
  std::function<bool(const RelaxProgress&)> on_progress = {};
};

struct RelaxResult {
  Atoms atoms;
  EnergyForces result;
  int steps = 0;
  int evaluations = 0;
  double largest_force = 0.0;  ///< [eV/Å]; with the springs that hold bonds
  bool converged = false;
  /// Bonds that would tear under the potential alone: springs hold them at 1.8 Å, where REBO pulls
  /// hardest. The energies and forces are those without springs.
  std::vector<Bond> held = {};
};

/// Moves atoms downhill until they are at rest.
///
/// Given the bonds of a network that are far from carbon's (below 1.25 or above 1.65 Å), atoms are
/// first moved by springs whose lengths go from those of the bonds to carbon's, then under the
/// potential with springs on bonds that leave these bounds, then under the potential alone. If that
/// ends where a bond wants to tear, springs hold such bonds (see RelaxResult::held). The bonds also
/// precondition L-BFGS [Packwood2016]: it then needs about a tenth of the steps.
///
/// Not reaching max_force is a result: see `converged`. The same bytes on any number of threads, if
/// the potential's are.
///
/// @throws InvalidAtoms   if bonds or fixed name atoms that do not exist, the potential throws it,
/// or
///                        has no finite energy where the atoms are.
/// @throws InvalidOption  if an option is out of its range.
///
/// Cost: steps · (evaluation of the potential + O(n log n)).
[[nodiscard]] RelaxResult relax(Atoms atoms, Potential& potential,
                                const RelaxOptions& options = {});

}  // namespace trivalent::potentials
