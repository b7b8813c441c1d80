#include <algorithm>
#include <cmath>

#include "relax/minimizer.h"

namespace trivalent::potentials::relax_detail {

namespace {

/// FIRE [Bitzek2006]. Masses are 1: a time step squared is an inverse curvature [Å²/eV].
class Fire : public Minimization {
 public:
  explicit Fire(double max_move) : max_move_(max_move) {}

  bool step(Objective& objective, Point& point) override {
    if (velocity_.size() == 0) velocity_.setZero(point.coordinates.size());
    if (dot(velocity_, point.gradient) > 0.0) slow_down(point);
    // Semi-implicit Euler, then velocities are turned towards the force.
    add_multiple(velocity_, -time_step_, point.gradient);
    const double speed = std::sqrt(dot(velocity_, velocity_));
    const double force = std::sqrt(dot(point.gradient, point.gradient));
    velocity_ *= 1.0 - mixing_;
    if (force > 0.0) add_multiple(velocity_, -mixing_ * speed / force, point.gradient);
    if (++downhill_ > patience) {
      time_step_ = std::min(time_step_ * 1.1, max_time_step);
      mixing_ *= 0.99;
    }
    return move(objective, point);
  }

 private:
  static constexpr double first_time_step = 0.05;
  static constexpr double max_time_step = 0.15;
  static constexpr double first_mixing = 0.25;
  static constexpr int patience = 20;

  void slow_down(Point&) {
    velocity_.setZero();
    mixing_ = first_mixing;
    time_step_ = std::max(0.5 * time_step_, 0.02 * first_time_step);
    downhill_ = 0;
  }

  bool move(Objective& objective, Point& point) {
    constexpr int max_attempts = 20;
    Point next;
    next.gradient.setZero(point.gradient.size());
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
      const double largest = largest_triple(velocity_);
      const double fraction =
          largest > 0.0 ? std::min(time_step_, max_move_ / largest) : time_step_;
      next.coordinates = point.coordinates;
      add_multiple(next.coordinates, fraction, velocity_);
      if (objective.evaluate(next)) {
        objective.accept();
        std::swap(point, next);
        return true;
      }
      slow_down(point);
      add_multiple(velocity_, -time_step_, point.gradient);
    }
    return false;
  }

  double max_move_;
  Vector velocity_;
  double time_step_ = first_time_step;
  double mixing_ = first_mixing;
  int downhill_ = 0;
};

}  // namespace

std::unique_ptr<Minimization> make_fire(double max_move) {
  return std::make_unique<Fire>(max_move);
}

}  // namespace trivalent::potentials::relax_detail
