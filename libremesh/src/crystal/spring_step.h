#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Directions in which a vertex may move: two in the tangent plane of the surface, one along a
/// feature curve, none at a corner.
struct MotionFrame {
  int freedoms = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the surface
};

/// Of a vertex with this anchor at this position.
[[nodiscard]] inline MotionFrame motion_frame(const ConstrainedMesh& constrained,
                                              const Eigen::Vector3d& position,
                                              const Anchor& anchor) {
  MotionFrame frame;
  frame.normal = constrained.surface().normal({position, anchor.face});
  if (anchor.kind == FeatureKind::none) {
    frame.freedoms = 2;
    frame.first = frame.normal.unitOrthogonal();
    frame.second = frame.normal.cross(frame.first);
  } else if (anchor.kind == FeatureKind::curve) {
    frame.freedoms = 1;
    frame.first = constrained.curves().tangent(anchor.on_curve);
  }
  return frame;
}

/// Steps are cut to this part of L.
constexpr double longest_spring_step = 0.25;
/// Overrelaxation: steps in the tangent plane are longer than to the vertex's own minimum by this,
/// since the neighbors give way.
constexpr double spring_overrelaxation = 1.4;

/// Newton's step of one vertex towards the minimum of Σ (|e|/L - 1)² over its edges, the other ends
/// held. An edge that is pressed counts as stiff only along itself, which keeps the Hessian
/// positive definite.
class SpringStep {
 public:
  explicit SpringStep(const MotionFrame& frame) : frame_(frame) {}

  void add_edge(const Eigen::Vector3d& edge, double length) {
    const double inverse = 1.0 / std::max(edge.norm(), 1e-6 * length);
    const double slack = 1.0 - length * inverse;  // < 0: pressed
    const double along_first = edge.dot(frame_.first);
    const double along_second = edge.dot(frame_.second);
    const double across = std::max(slack, 0.0);
    const double along = (1.0 - across) * inverse * inverse;
    pull_first_ += slack * along_first;
    pull_second_ += slack * along_second;
    stiffness_11_ += across + along * along_first * along_first;
    stiffness_12_ += along * along_first * along_second;
    stiffness_22_ += across + along * along_second * along_second;
  }

  [[nodiscard]] Eigen::Vector3d displacement(double length) const {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    if (frame_.freedoms == 1 && stiffness_11_ > 1e-9) {
      step = pull_first_ / stiffness_11_ * frame_.first;
    } else if (frame_.freedoms == 2) {
      const double determinant = stiffness_11_ * stiffness_22_ - stiffness_12_ * stiffness_12_;
      if (!(determinant > 1e-9)) return step;
      const double factor = spring_overrelaxation / determinant;
      step = factor * (stiffness_22_ * pull_first_ - stiffness_12_ * pull_second_) * frame_.first +
             factor * (stiffness_11_ * pull_second_ - stiffness_12_ * pull_first_) * frame_.second;
    }
    const double size = step.norm();
    const double longest = longest_spring_step * length;
    return size > longest ? Eigen::Vector3d(step * (longest / size)) : step;
  }

 private:
  const MotionFrame& frame_;
  double pull_first_ = 0.0;
  double pull_second_ = 0.0;
  double stiffness_11_ = 0.0;
  double stiffness_12_ = 0.0;
  double stiffness_22_ = 0.0;
};

}  // namespace trivalent::remesh
