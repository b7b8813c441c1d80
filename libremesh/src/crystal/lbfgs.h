#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace trivalent::remesh {

/// Minimizer of limited memory [Liu1989] with a preconditioner, for many small problems: it keeps
/// its storage from one to the next.
template <typename Scalar>
class Lbfgs {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  struct Limits {
    int max_steps;
    Scalar max_move;       ///< largest change of a component in one step
    Scalar tolerance;      ///< ends once the predicted decrease is less [energy]
    bool rescales = true;  ///< whether the preconditioner is right only but for a factor
  };

  /// Moves x towards a minimum.
  ///
  /// @param evaluate      (x, gradient&) -> energy
  /// @param precondition  (vector&): multiplies it by an approximate inverse Hessian
  /// @param gives_up      (energy, predicted decrease) -> bool; ends early once true
  /// @return              The energy.
  template <typename Evaluate, typename Precondition, typename GivesUp>
  Scalar minimize(Vector& x, const Limits& limits, const Evaluate& evaluate,
                  const Precondition& precondition, const GivesUp& gives_up) {
    kept_ = 0;
    scale_ = Scalar(1);
    gradient_.resize(x.size());
    Scalar energy = evaluate(x, gradient_);
    for (int step = 0; step < limits.max_steps; ++step) {
      find_direction(precondition);
      Scalar slope = direction_.dot(gradient_);
      if (!(slope < Scalar(0))) {
        kept_ = 0;
        find_direction(precondition);
        slope = direction_.dot(gradient_);
      }
      const Scalar predicted = Scalar(-0.5) * slope;
      if (!(predicted > limits.tolerance) || gives_up(energy, predicted)) break;
      if (!search(x, energy, slope, limits, evaluate)) break;
      if (limits.rescales) rescale(precondition);
    }
    return energy;
  }

 private:
  static constexpr int memory = 6;

  template <typename Precondition>
  void find_direction(const Precondition& precondition) {
    direction_ = -gradient_;
    std::array<Scalar, memory> alpha{};
    for (int k = kept_ - 1; k >= 0; --k) {
      const auto i = slot(k);
      alpha[i] = inverse_[i] * step_[i].dot(direction_);
      direction_ -= alpha[i] * change_[i];
    }
    precondition(direction_);
    if (kept_ > 0) direction_ *= scale_;
    for (int k = 0; k < kept_; ++k) {
      const auto i = slot(k);
      const Scalar beta = inverse_[i] * change_[i].dot(direction_);
      direction_ += (alpha[i] - beta) * step_[i];
    }
  }

  /// The last step tells the factor of the preconditioner.
  template <typename Precondition>
  void rescale(const Precondition& precondition) {
    if (kept_ == 0) return;
    const auto i = slot(kept_ - 1);
    trial_ = change_[i];
    precondition(trial_);
    scale_ = Scalar(1) / (inverse_[i] * change_[i].dot(trial_));
  }

  /// Backtracks until the energy is low enough; false if it cannot be lowered.
  template <typename Evaluate>
  bool search(Vector& x, Scalar& energy, Scalar slope, const Limits& limits,
              const Evaluate& evaluate) {
    constexpr int max_tries = 8;
    constexpr Scalar sufficient = Scalar(1e-4);
    Scalar size = std::min(Scalar(1), limits.max_move / direction_.cwiseAbs().maxCoeff());
    for (int k = 0; k < max_tries; ++k) {
      trial_ = x + size * direction_;
      next_gradient_.resize(x.size());
      const Scalar reached = evaluate(trial_, next_gradient_);
      if (reached <= energy + sufficient * size * slope) {
        remember(x);
        x.swap(trial_);
        gradient_.swap(next_gradient_);
        energy = reached;
        return true;
      }
      // The minimum of the parabola through what is known.
      const Scalar curvature = reached - energy - size * slope;
      const Scalar parabola = Scalar(-0.5) * slope * size * size / curvature;
      size = std::clamp(parabola, Scalar(0.1) * size, Scalar(0.5) * size);
    }
    return false;
  }

  void remember(const Vector& x) {
    if (kept_ == memory) oldest_ = (oldest_ + 1) % memory;
    if (kept_ == 0) oldest_ = 0;
    if (kept_ < memory) ++kept_;
    const auto i = slot(kept_ - 1);
    step_[i] = trial_ - x;
    change_[i] = next_gradient_ - gradient_;
    const Scalar product = step_[i].dot(change_[i]);
    if (!(product > Scalar(1e-10) * step_[i].squaredNorm())) {
      --kept_;  // not convex along this step
      return;
    }
    inverse_[i] = Scalar(1) / product;
  }

  [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] std::size_t slot(int k) const { return at((oldest_ + k) % memory); }

  int kept_ = 0;
  int oldest_ = 0;
  Scalar scale_ = Scalar(1);
  std::array<Vector, memory> step_;
  std::array<Vector, memory> change_;
  std::array<Scalar, memory> inverse_{};
  Vector gradient_;
  Vector direction_;
  Vector trial_;
  Vector next_gradient_;
};

}  // namespace trivalent::remesh
