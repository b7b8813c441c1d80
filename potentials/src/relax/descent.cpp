#include "relax/descent.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "relax/minimizer.h"
#include "trivalent/potentials/error.h"

namespace trivalent::potentials::relax_detail {

namespace {

/// Whether the last steps together lowered the energy by less than wanted.
class Settling {
 public:
  /// @param change  [eV]; 0: never
  Settling(double change, double energy) : change_(change), energies_{energy} {}

  [[nodiscard]] bool is_reached(double energy) {
    constexpr std::size_t window = 10;
    energies_.push_back(energy);
    if (energies_.size() <= window) return false;
    const double gain = energies_.front() - energy;
    energies_.pop_front();
    return change_ > 0.0 && gain < change_;
  }

 private:
  double change_;
  std::deque<double> energies_;  // of the last steps
};

class Descent {
 public:
  Descent(RelaxResult& result, const DescentOptions& descent, const RelaxOptions& options)
      : result_(result),
        descent_(descent),
        options_(options),
        first_evaluation_(result.evaluations),
        objective_(std::move(result.atoms), descent, options.fixed),
        point_(objective_.start()) {}

  void run() {
    if (!objective_.evaluate(point_)) {
      throw InvalidAtoms("relax: the atoms have no finite energy where they are");
    }
    const auto minimization = descent_.minimizer == Minimizer::fire
                                  ? make_fire(descent_.max_move)
                                  : make_lbfgs(descent_.max_move, descent_.preconditioner);
    const auto n_atoms = static_cast<double>(objective_.atoms().size());
    Settling settling(options_.energy_change * n_atoms, point_.energy);
    const int last_step = std::min(result_.steps + descent_.max_steps, options_.max_steps);
    std::optional<RelaxEnd> end = end_here();
    while (!end && result_.steps < last_step) {
      if (!minimization->step(objective_, point_)) {
        end = RelaxEnd::no_descent;
        break;
      }
      ++result_.steps;
      end = end_here();
      const bool has_settled = settling.is_reached(point_.energy);
      if (!end && descent_.stage == RelaxStage::free && has_settled) end = RelaxEnd::energy_settled;
    }
    finish(end.value_or(RelaxEnd::out_of_steps));
  }

 private:
  /// Reports the progress; says whether the descent ends here, and why.
  [[nodiscard]] std::optional<RelaxEnd> end_here() {
    update();
    const bool may_go_on =
        !options_.on_progress || options_.on_progress({.stage = descent_.stage,
                                                       .steps = result_.steps,
                                                       .evaluations = result_.evaluations,
                                                       .energy = own_energy(),
                                                       .largest_force = own_force(),
                                                       .atoms = objective_.atoms()});
    if (!may_go_on) return RelaxEnd::stopped;
    if (largest_triple(point_.gradient) <= descent_.max_force) return RelaxEnd::at_rest;
    return std::nullopt;
  }

  void update() {
    result_.evaluations = first_evaluation_ + objective_.evaluations();
    if (const auto force = own_force()) result_.largest_force = *force;
  }

  [[nodiscard]] std::optional<double> own_energy() const {
    if (descent_.potential == nullptr) return std::nullopt;
    return objective_.result().energy;
  }
  [[nodiscard]] std::optional<double> own_force() const {
    if (descent_.potential == nullptr) return std::nullopt;
    return objective_.largest_force();
  }

  void finish(RelaxEnd end) {
    // A step that failed has left the atoms elsewhere.
    if (end == RelaxEnd::no_descent) (void)objective_.evaluate(point_);
    update();
    result_.end = end;
    result_.converged = end == RelaxEnd::at_rest || end == RelaxEnd::energy_settled;
    result_.atoms = objective_.take_atoms();
    result_.result = objective_.take_result();
  }

  RelaxResult& result_;
  const DescentOptions& descent_;
  const RelaxOptions& options_;
  int first_evaluation_;
  Objective objective_;
  Point point_;
};

}  // namespace

void descend(RelaxResult& result, const DescentOptions& descent, const RelaxOptions& options) {
  Descent(result, descent, options).run();
}

}  // namespace trivalent::potentials::relax_detail
