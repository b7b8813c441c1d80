#pragma once

#include <cstdint>
#include <functional>
#include <optional>
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

/// What acts on the atoms.
enum class RelaxStage {
  trial,    ///< the potential, where it is not yet known which of two ways leads lower
  springs,  ///< springs along the bonds of the network, which cannot tear
  guarded,  ///< the potential, and springs on bonds that become too long or too short
  free,     ///< the potential
  held      ///< the potential, and springs on bonds that want to tear
};

/// Where a relaxation begins.
enum class RelaxStart {
  gentle,  ///< rough structures first with springs: see relax()
  direct   ///< under the potential
};

/// Why a relaxation ended.
enum class RelaxEnd {
  at_rest,         ///< no atom has more than max_force
  energy_settled,  ///< see RelaxOptions::energy_change
  out_of_steps,
  stopped,     ///< by on_progress
  no_descent,  ///< no step along the forces lowers the energy
  bonds_held   ///< springs hold bonds that the potential would tear
};

/// How far a relaxation has come.
struct RelaxProgress {
  RelaxStage stage;
  int steps;                            ///< of all stages
  int evaluations;                      ///< of energy and forces
  std::optional<double> energy;         ///< of the potential [eV]; none while only springs act
  std::optional<double> largest_force;  ///< of the potential, on an atom that may move [eV/Å]
  const Atoms& atoms;                   ///< as they are now
};

/// Where a relaxation under the potential can be resumed: the result is the same as if it had gone
/// on.
struct RelaxCheckpoint {
  int steps;
  int evaluations;
  const Atoms& atoms;
};

struct RelaxOptions {
  Minimizer minimizer = Minimizer::lbfgs;
  double max_force = 1e-3;  ///< [eV/Å], > 0: converged once no atom has more
  /// [eV per atom], >= 0: converged also once ten steps together lower the energy by less; 0: never
  double energy_change = 0.0;
  int max_steps = 20000;  ///< >= 0, of all stages
  double max_move = 0.1;  ///< [Å], > 0: no atom goes farther in one step
  RelaxStart start = RelaxStart::gentle;
  BoxPolicy box = BoxPolicy::fixed;
  std::vector<std::uint32_t> fixed = {};  ///< atoms that stay
  /// Of the network, if it is known: they are then kept.
  std::vector<Bond> bonds = {};
  int first_step = 0;        ///< >= 0: steps taken before, where a relaxation is resumed
  int first_evaluation = 0;  ///< likewise
  int checkpoint_every =
      200;  ///< steps under the potential, >= 1: the minimizer then starts afresh
  /// Called at the start and every checkpoint_every steps under the potential.
  std::function<void(const RelaxCheckpoint&)> on_checkpoint = {};
  /// Called before the first step and after each; returns false to stop there.
  std::function<bool(const RelaxProgress&)> on_progress = {};
};

/// Energies and forces here are the potential's own, whatever springs there were.
struct RelaxResult {
  Atoms atoms;
  EnergyForces result;
  int steps = 0;
  int evaluations = 0;
  double largest_force = 0.0;  ///< on an atom that may move [eV/Å]
  RelaxEnd end = RelaxEnd::out_of_steps;
  bool converged = false;       ///< at rest, or the energy has settled
  std::vector<Bond> held = {};  ///< bonds that springs hold, since the potential would tear them
};

/// Moves atoms downhill until they are at rest.
///
/// If the bonds of the network are known, they are kept. A rough network (a carbon bond below 1.25
/// or above 1.65 Å, or a pair without a bond within REBO's reach) is first moved by springs whose
/// lengths go from those of the bonds to carbon's, then under the potential with springs on bonds
/// that leave these bounds, then under the potential alone. No step under it tears a bond. If that
/// ends where a bond wants to tear, springs hold such bonds; the atoms are then not at rest (see
/// RelaxResult::held).
///
/// Without a network, the atoms go down under the potential alone, and bonds may break and form. A
/// rough structure is also tried with springs between guessed bonds (guess_bonds()) at the start;
/// the lower of the two is relaxed to the end, under the potential alone.
///
/// Bonds, known or guessed, precondition L-BFGS [Packwood2016]: it then needs about a tenth of the
/// steps. The potential forgets what it keeps at each checkpoint. Not reaching max_force is a
/// result: see `converged`. The same bytes on any number of threads, if the potential's are.
///
/// @throws InvalidAtoms   if bonds or fixed name atoms that do not exist, if the potential throws
///                        it, or if it has no finite energy at the start.
/// @throws InvalidOption  if an option is out of its range.
///
/// Cost: steps · (evaluation of the potential + O(n log n)).
[[nodiscard]] RelaxResult relax(Atoms atoms, Potential& potential,
                                const RelaxOptions& options = {});

}  // namespace trivalent::potentials
