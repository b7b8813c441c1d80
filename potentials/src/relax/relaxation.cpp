#include "relax/relaxation.h"

#include <algorithm>
#include <cmath>

#include "relax/spring_recipes.h"

namespace trivalent::potentials::relax_detail {

Relaxation::Relaxation(Atoms atoms, Potential& potential, const RelaxOptions& options)
    : potential_(potential), options_(options) {
  result_.atoms = std::move(atoms);
  set_bonds(options.bonds.empty() ? guess_bonds(result_.atoms).bonds : options.bonds);
  result_.steps = options.first_step;
  result_.evaluations = options.first_evaluation;
}

void Relaxation::set_bonds(std::vector<Bond> bonds) {
  bonds_ = std::move(bonds);
  preconditioner_.reset();
  if (options_.minimizer == Minimizer::fire || bonds_.empty()) return;
  preconditioner_.emplace(result_.atoms, bonds_, options_.fixed);
}

RelaxResult Relaxation::run() && {
  if (options_.start == RelaxStart::gentle && is_rough(result_.atoms, bonds_)) {
    if (is_network_known()) {
      start_gently(result_);
    } else {
      choose_start();
    }
  }
  if (result_.end == RelaxEnd::stopped) {
    measure();
    return std::move(result_);
  }
  descend_freely();
  if (result_.end == RelaxEnd::no_descent && is_network_known()) hold_bonds();
  return std::move(result_);
}

// L-BFGS takes long steps and leaves the basin of a rough structure; FIRE follows the forces. In
// 200 rattled structures (scripts/check_relax.sh) one way alone misses what the others find in 2 to
// 3 %.
void Relaxation::choose_start() {
  const RelaxResult start = std::move(result_);
  result_ = start;
  try_out(result_, options_.max_move);
  if (result_.end == RelaxEnd::stopped || has_kept_bonds(result_)) return;
  for (const Way way : {Way::short_steps, Way::springs}) {
    RelaxResult other = start;
    other.steps = result_.steps;
    other.evaluations = result_.evaluations;
    if (way == Way::springs) start_gently(other);
    if (other.end != RelaxEnd::stopped) {
      try_out(other, way == Way::short_steps ? 0.5 * options_.max_move : options_.max_move);
    }
    const bool is_lower =
        other.end != RelaxEnd::stopped && other.result.energy < result_.result.energy;
    result_.steps = other.steps;
    result_.evaluations = other.evaluations;
    result_.end = other.end;
    if (result_.end == RelaxEnd::stopped) return;
    if (is_lower) result_ = std::move(other);
  }
}

bool Relaxation::has_kept_bonds(const RelaxResult& result) const {
  const BondChanges changes = bond_changes(result.atoms, bonds_);
  return changes.broken.empty() && changes.formed.empty();
}

void Relaxation::try_out(RelaxResult& result, double max_move) {
  constexpr double settled_force = 0.05;  // [eV/Å]; what is left to gain is small against a bond
  constexpr int max_trial_steps = 1000;
  descend(result,
          {.stage = RelaxStage::trial,
           .potential = &potential_,
           .minimizer = Minimizer::fire,
           .max_move = max_move,
           .max_force = std::max(settled_force, options_.max_force),
           .max_steps = max_trial_steps},
          options_);
}

void Relaxation::start_gently(RelaxResult& result) {
  constexpr int swelling_steps = 100;
  constexpr int settling_steps = 600;
  constexpr int bounded_steps = 1000;
  const Swelling swelling(result.atoms, bonds_);
  for (int part = 1; part <= swelling.part_count(); ++part) {
    const int steps = part < swelling.part_count() ? swelling_steps : settling_steps;
    if (!draw(result, swelling.springs(part, swelling_smoothness), steps)) return;
  }
  if (!draw(result, swelling.springs(swelling.part_count(), final_smoothness), settling_steps)) {
    return;
  }
  NetworkSprings bounds(result.atoms, bonds_, bounding_springs(result.atoms, bonds_));
  descend(result,
          {.stage = RelaxStage::guarded,
           .potential = &potential_,
           .springs = &bounds,
           .minimizer = options_.minimizer,
           .max_move = options_.max_move,
           .max_force = std::max(rough_force, options_.max_force),
           .max_steps = bounded_steps,
           .preconditioner = preconditioner()},
          options_);
}

bool Relaxation::draw(RelaxResult& result, const SpringOptions& springs, int max_steps) {
  NetworkSprings network(result.atoms, bonds_, springs);
  descend(result,
          {.stage = RelaxStage::springs,
           .springs = &network,
           .minimizer = options_.minimizer,
           .max_move = options_.max_move,
           .max_force = rough_force,
           .max_steps = max_steps,
           .preconditioner = preconditioner()},
          options_);
  return result.end != RelaxEnd::stopped;
}

void Relaxation::descend_freely() {
  do {
    // Nothing but the atoms may matter from here on, so that a relaxation can be resumed.
    potential_.forget();
    if (!is_network_known()) {
      set_bonds(guess_bonds(result_.atoms).bonds);
    } else if (preconditioner_ && preconditioner_->depends_on_positions()) {
      set_bonds(bonds_);
    }
    if (options_.on_checkpoint) {
      options_.on_checkpoint({result_.steps, result_.evaluations, result_.atoms});
    }
    descend(result_,
            {.stage = RelaxStage::free,
             .potential = &potential_,
             .minimizer = options_.minimizer,
             .max_move = options_.max_move,
             .max_force = options_.max_force,
             .max_steps = options_.checkpoint_every,
             .guarded = options_.bonds,
             .box = options_.box,
             .preconditioner = preconditioner()},
            options_);
  } while (result_.end == RelaxEnd::out_of_steps && result_.steps < options_.max_steps);
}

void Relaxation::hold_bonds() {
  if (options_.box != BoxPolicy::fixed || result_.steps >= options_.max_steps) return;
  NetworkSprings holds(result_.atoms, bonds_, holding_springs(result_.atoms, bonds_));
  descend(result_,
          {.stage = RelaxStage::held,
           .potential = &potential_,
           .springs = &holds,
           .minimizer = options_.minimizer,
           .max_move = options_.max_move,
           .max_force = options_.max_force,
           .max_steps = options_.max_steps,
           .preconditioner = preconditioner()},
          options_);
  const auto& species = result_.atoms.species;
  std::ranges::copy_if(bonds_, std::back_inserter(result_.held), [&](const Bond& bond) {
    return bond_length(result_.atoms, bond) >
           max_free_bond(species[bond.first], species[bond.second]);
  });
  if (result_.held.empty()) return;
  result_.converged = false;
  if (result_.end == RelaxEnd::at_rest) result_.end = RelaxEnd::bonds_held;
}

void Relaxation::measure() {
  result_.converged = false;
  result_.result = potential_.evaluate(result_.atoms);
  std::vector<bool> is_fixed(result_.atoms.size(), false);
  for (const std::uint32_t atom : options_.fixed) is_fixed[atom] = true;
  result_.largest_force = 0.0;
  for (std::size_t i = 0; i < is_fixed.size(); ++i) {
    if (is_fixed[i]) continue;
    result_.largest_force = std::max(result_.largest_force, result_.result.forces[i].norm());
  }
}

}  // namespace trivalent::potentials::relax_detail
