#include "trivalent/potentials/relax.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "relax/minimizer.h"
#include "relax/network_springs.h"
#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials {

namespace relax_detail {

namespace {

/// What one stage adds to the options.
struct StageOptions {
  RelaxStage stage;
  double max_force;  ///< [eV/Å]
  int max_steps;
};

/// A potential and springs.
class WithSprings : public Potential {
 public:
  WithSprings(Potential& potential, NetworkSprings& springs)
      : potential_(potential), springs_(springs) {}

 private:
  void compute(const Atoms& atoms, EnergyForces& result) override {
    result = potential_.evaluate(atoms, std::move(result));
    addition_ = springs_.evaluate(atoms, std::move(addition_));
    result.energy += addition_.energy;
    for (std::size_t i = 0; i < result.forces.size(); ++i) result.forces[i] += addition_.forces[i];
  }

  Potential& potential_;
  NetworkSprings& springs_;
  EnergyForces addition_;
};

/// Runs the stages of a relaxation one after the other.
class Relaxation {
 public:
  Relaxation(Atoms atoms, Potential& potential, const RelaxOptions& options)
      : potential_(potential), options_(options), n_atoms_(static_cast<double>(atoms.size())) {
    result_.atoms = std::move(atoms);
    result_.steps = options.first_step;
    result_.evaluations = options.first_evaluation;
    if (options.minimizer == Minimizer::lbfgs && !options.bonds.empty()) {
      network_.emplace(result_.atoms.size(), options.bonds, options.fixed);
    }
  }

  RelaxResult run() && {
    if (options_.start == RelaxStart::gentle && !has_carbon_bonds()) start_gently();
    bool can_go_on = !was_stopped_;
    while (can_go_on) {
      if (options_.on_checkpoint) {
        options_.on_checkpoint({result_.steps, result_.evaluations, result_.atoms});
      }
      can_go_on = descend(potential_, {.stage = RelaxStage::free,
                                       .max_force = options_.max_force,
                                       .max_steps = options_.checkpoint_every});
    }
    if (!result_.converged && !was_stopped_ && result_.steps < options_.max_steps) hold_bonds();
    // A stage that was stopped may have been one of springs.
    if (was_stopped_) result_.result = potential_.evaluate(result_.atoms);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool has_carbon_bonds() const;
  void start_gently();
  /// Draws the network towards bonds of these lengths [Å].
  void draw_by_springs(const std::vector<double>& lengths, double smoothness, int max_steps);
  /// Puts springs on bonds that want to tear.
  void hold_bonds();
  /// Returns whether it ended only because of the stage's number of steps.
  bool descend(Potential& potential, const StageOptions& stage);
  [[nodiscard]] bool wants_more(const StageOptions& stage, const Objective& objective,
                                const Point& point);

  [[nodiscard]] bool has_settled(std::deque<double>& energies, double energy) const;

  Potential& potential_;
  const RelaxOptions& options_;
  double n_atoms_;
  std::optional<BondLaplacian> network_;
  RelaxResult result_;
  bool was_stopped_ = false;
};

// sp2 bonds under no great strain [Å].
constexpr double carbon_bond = 1.42;
constexpr double shortest_bond = 1.25;
constexpr double longest_bond = 1.65;
// REBO pulls hardest at about this length; what is pulled farther tears [Å].
constexpr double longest_free_bond = 1.8;

bool Relaxation::has_carbon_bonds() const {
  return std::all_of(options_.bonds.begin(), options_.bonds.end(), [&](const Bond& bond) {
    const auto& species = result_.atoms.species;
    const bool is_carbon =
        species[bond.first] == Species::carbon && species[bond.second] == Species::carbon;
    if (!is_carbon) return true;
    const double length = bond_length(result_.atoms, bond);
    return length >= shortest_bond && length <= longest_bond;
  });
}

// From the lengths that bonds have to those of carbon, step by step: where they are short the
// surface swells, and would otherwise fold into itself.
void Relaxation::start_gently() {
  std::vector<double> logarithms;
  for (const Bond& bond : options_.bonds) {
    logarithms.push_back(std::log(bond_length(result_.atoms, bond) / carbon_bond));
  }
  constexpr double largest_part = 0.17;  // about as in 1.42 to 1.2 Å
  double largest = 0.0;
  for (const double logarithm : logarithms) largest = std::max(largest, std::abs(logarithm));
  const int n_parts =
      std::max(1, static_cast<int>(std::min(100.0, std::ceil(largest / largest_part))));
  std::vector<double> lengths(logarithms.size());
  for (int part = 1; part <= n_parts; ++part) {
    const double left = static_cast<double>(n_parts - part) / n_parts;
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      lengths[k] = carbon_bond * std::exp(left * logarithms[k]);
    }
    draw_by_springs(lengths, 2.0, part < n_parts ? 100 : 600);
  }
  draw_by_springs(lengths, 0.5, 600);
  if (was_stopped_) return;
  NetworkSprings bounds(result_.atoms, options_.bonds,
                        {.bond_stiffness = 100.0,
                         .shortest = shortest_bond,
                         .longest = longest_bond,
                         .smoothness = 0.0,
                         .contact = {.second = 2.05, .third = 2.3, .others = 2.6},
                         .contact_stiffness = 100.0});
  WithSprings bounded(potential_, bounds);
  descend(bounded, {.stage = RelaxStage::guarded,
                    .max_force = std::max(0.3, options_.max_force),
                    .max_steps = 1000});
}

void Relaxation::draw_by_springs(const std::vector<double>& lengths, double smoothness,
                                 int max_steps) {
  if (was_stopped_) return;
  NetworkSprings springs(result_.atoms, options_.bonds,
                         {.bond_stiffness = 20.0,
                          .shortest = carbon_bond,
                          .longest = carbon_bond,
                          .smoothness = smoothness,
                          .contact = {.second = 2.2, .third = 2.5, .others = 3.0},
                          .contact_stiffness = 20.0,
                          .rest_lengths = lengths});
  descend(springs, {.stage = RelaxStage::springs, .max_force = 0.3, .max_steps = max_steps});
}

void Relaxation::hold_bonds() {
  if (options_.bonds.empty() || options_.box != BoxPolicy::fixed) return;
  NetworkSprings holds(result_.atoms, options_.bonds,
                       {.bond_stiffness = 200.0,
                        .shortest = 0.0,
                        .longest = longest_free_bond,
                        .smoothness = 0.0,
                        .contact = {},
                        .contact_stiffness = 0.0});
  WithSprings holding(potential_, holds);
  descend(holding, {.stage = RelaxStage::held,
                    .max_force = options_.max_force,
                    .max_steps = options_.max_steps});
  for (const Bond& bond : options_.bonds) {
    if (bond_length(result_.atoms, bond) > longest_free_bond) result_.held.push_back(bond);
  }
  result_.result = potential_.evaluate(result_.atoms);
}

bool Relaxation::descend(Potential& potential, const StageOptions& stage) {
  RelaxOptions options = options_;
  if (stage.stage != RelaxStage::free) {
    options.box = BoxPolicy::fixed;
    options.bonds.clear();
  }
  Objective objective(std::move(result_.atoms), potential, options);
  Point point = objective.start();
  if (!objective.evaluate(point)) {
    throw InvalidAtoms("relax: the atoms have no finite energy where they are");
  }
  const auto minimization = options.minimizer == Minimizer::fire
                                ? make_fire(options.max_move)
                                : make_lbfgs(options.max_move, network_ ? &*network_ : nullptr);
  const int last_step = std::min(result_.steps + stage.max_steps, options_.max_steps);
  std::deque<double> energies = {point.energy};  // of the last steps
  bool is_under_way = wants_more(stage, objective, point);
  while (is_under_way && result_.steps < last_step) {
    if (!minimization->step(objective, point)) {
      is_under_way = false;
      break;
    }
    ++result_.steps;
    is_under_way = wants_more(stage, objective, point);
    if (stage.stage == RelaxStage::free && has_settled(energies, point.energy)) {
      result_.converged = true;
      is_under_way = false;
    }
  }
  (void)objective.evaluate(point);  // a step that failed has left the atoms elsewhere
  result_.atoms = objective.atoms();
  result_.result = objective.result();
  result_.evaluations += objective.evaluations();
  return is_under_way && result_.steps < options_.max_steps;
}

bool Relaxation::wants_more(const StageOptions& stage, const Objective& objective,
                            const Point& point) {
  result_.largest_force = largest_triple(point.gradient);
  result_.converged = result_.largest_force <= stage.max_force;
  const bool may_go_on =
      !options_.on_progress ||
      options_.on_progress({.stage = stage.stage,
                            .steps = result_.steps,
                            .evaluations = result_.evaluations + objective.evaluations(),
                            .energy = point.energy,
                            .largest_force = result_.largest_force,
                            .atoms = objective.atoms()});
  was_stopped_ = was_stopped_ || !may_go_on;
  return may_go_on && !result_.converged;
}

// Takes the energy down; says whether the last ten steps have brought less than wanted.
bool Relaxation::has_settled(std::deque<double>& energies, double energy) const {
  constexpr std::size_t window = 10;
  energies.push_back(energy);
  if (energies.size() <= window) return false;
  const double gain = energies.front() - energy;
  energies.pop_front();
  return options_.energy_change > 0.0 && gain < options_.energy_change * n_atoms_;
}

}  // namespace

}  // namespace relax_detail

namespace {

void check_options(const Atoms& atoms, const RelaxOptions& options) {
  require_positive(options.max_force, "relax", "max_force");
  require_positive(options.max_move, "relax", "max_move");
  require_positive(options.bond_limit, "relax", "bond_limit");
  if (!(options.energy_change >= 0.0)) throw InvalidOption("relax: energy_change must be >= 0");
  if (options.max_steps < 0) throw InvalidOption("relax: max_steps must be >= 0");
  if (options.checkpoint_every < 1) throw InvalidOption("relax: checkpoint_every must be >= 1");
  const auto require_atom = [&](std::uint32_t atom, std::string_view what) {
    if (atom < atoms.size()) return;
    throw InvalidAtoms(concat("relax: ", what, " names atom ", atom, "; there are ", atoms.size()));
  };
  for (const std::uint32_t atom : options.fixed) require_atom(atom, "fixed");
  for (const Bond& bond : options.bonds) {
    require_atom(bond.first, "a bond");
    require_atom(bond.second, "a bond");
  }
}

}  // namespace

RelaxResult relax(Atoms atoms, Potential& potential, const RelaxOptions& options) {
  require_valid(atoms, "relax");
  check_options(atoms, options);
  return relax_detail::Relaxation(std::move(atoms), potential, options).run();
}

}  // namespace trivalent::potentials
