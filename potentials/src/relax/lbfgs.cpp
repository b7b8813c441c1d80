#include <cmath>
#include <deque>

#include "relax/minimizer.h"

namespace trivalent::potentials::relax_detail {

namespace {

/// Limited-memory BFGS [Nocedal2006, Algorithm 7.5]. A step that does not lower the energy, or
/// would tear a bond, is shortened.
class Lbfgs : public Minimization {
 public:
  Lbfgs(double max_move, const BondLaplacian* preconditioner)
      : max_move_(max_move), preconditioner_(preconditioner) {}

  bool step(Objective& objective, Point& point) override {
    if (try_direction(objective, point)) return true;
    if (memory_.empty()) return false;
    memory_.clear();
    return try_direction(objective, point);
  }

 private:
  struct Pair {
    Vector step;
    Vector gradient_change;
    double product;  // of the two
  };

  bool try_direction(Objective& objective, Point& point) {
    Vector direction = find_direction(point.gradient);
    double slope = dot(direction, point.gradient);
    if (!(slope < 0.0)) {
      memory_.clear();
      direction = find_direction(point.gradient);
      slope = dot(direction, point.gradient);
    }
    const double largest = largest_triple(direction);
    if (!(largest > 0.0)) return false;
    double fraction = std::min(1.0, max_move_ / largest);
    constexpr int max_attempts = 20;
    Point next;
    next.gradient.setZero(point.gradient.size());
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
      next.coordinates = point.coordinates;
      add_multiple(next.coordinates, fraction, direction);
      if (!objective.evaluate(next)) {
        fraction *= 0.5;
        continue;
      }
      if (is_lower(point, next, fraction * slope, dot(next.gradient, direction) * fraction)) {
        objective.accept();
        remember(point, next);
        std::swap(point, next);
        return true;
      }
      fraction *= shrink(point.energy, next.energy, fraction * slope);
    }
    return false;
  }

  static bool is_lower(const Point& from, const Point& to, double slope, double next_slope) {
    constexpr double sufficient = 1e-4;
    if (to.energy <= from.energy + sufficient * slope) return true;
    // Where energies differ by rounding only, slopes still tell [Hager2005, eq. 4.1].
    const double rounding = 1e-13 * std::abs(from.energy);
    return to.energy <= from.energy + rounding && next_slope <= (2.0 * sufficient - 1.0) * slope;
  }

  // The minimum of the parabola through both energies and the slope, within bounds.
  static double shrink(double before, double after, double slope) {
    const double curvature = after - before - slope;
    const double best = curvature > 0.0 ? -0.5 * slope / curvature : 0.5;
    return std::clamp(best, 0.1, 0.5);
  }

  [[nodiscard]] Vector find_direction(const Vector& gradient) const {
    Vector direction = -gradient;
    std::vector<double> shares(memory_.size());
    for (std::size_t k = memory_.size(); k-- > 0;) {
      shares[k] = dot(memory_[k].step, direction) / memory_[k].product;
      add_multiple(direction, -shares[k], memory_[k].gradient_change);
    }
    if (preconditioner_) {
      preconditioner_->solve(direction);
    } else {
      direction *= inverse_curvature();
    }
    for (std::size_t k = 0; k < memory_.size(); ++k) {
      const double back = dot(memory_[k].gradient_change, direction) / memory_[k].product;
      add_multiple(direction, shares[k] - back, memory_[k].step);
    }
    return direction;
  }

  // Along the last step [Å²/eV].
  [[nodiscard]] double inverse_curvature() const {
    // Before anything is known: a tenth of what would stretch a carbon bond.
    if (memory_.empty()) return 0.01;
    return memory_.back().product /
           dot(memory_.back().gradient_change, memory_.back().gradient_change);
  }

  void remember(const Point& from, const Point& to) {
    Pair pair = {.step = to.coordinates - from.coordinates,
                 .gradient_change = to.gradient - from.gradient,
                 .product = 0.0};
    pair.product = dot(pair.step, pair.gradient_change);
    // Without curvature along the step there is nothing to learn.
    constexpr double min_inverse_curvature = 1e-12;  // [Å²/eV]
    if (!(pair.product > min_inverse_curvature * dot(pair.gradient_change, pair.gradient_change)))
      return;
    constexpr std::size_t max_pairs = 8;
    if (memory_.size() == max_pairs) memory_.pop_front();
    memory_.push_back(std::move(pair));
  }

  double max_move_;
  const BondLaplacian* preconditioner_;
  std::deque<Pair> memory_;
};

}  // namespace

std::unique_ptr<Minimization> make_lbfgs(double max_move, const BondLaplacian* preconditioner) {
  return std::make_unique<Lbfgs>(max_move, preconditioner);
}

}  // namespace trivalent::potentials::relax_detail
