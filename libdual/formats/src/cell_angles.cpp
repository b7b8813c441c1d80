#include "trivalent/formats/cell_angles.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace trivalent::dual {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / degree;
}

double cosine(double angle) { return angle == 90.0 ? 0.0 : std::cos(angle * degree); }

}  // namespace

CellAngles cell_angles(const Eigen::Matrix3d& cell) {
  const Eigen::Vector3d a = cell.col(0);
  const Eigen::Vector3d b = cell.col(1);
  const Eigen::Vector3d c = cell.col(2);
  return {.lengths = {a.norm(), b.norm(), c.norm()},
          .angles = {angle_between(b, c), angle_between(a, c), angle_between(a, b)}};
}

Eigen::Matrix3d cell_of(const CellAngles& parameters) {
  const auto [a, b, c] = parameters.lengths;
  const double cos_alpha = cosine(parameters.angles[0]);
  const double cos_beta = cosine(parameters.angles[1]);
  const double cos_gamma = cosine(parameters.angles[2]);
  const double sin_gamma = std::sqrt(1.0 - cos_gamma * cos_gamma);
  const double y = (cos_alpha - cos_beta * cos_gamma) / sin_gamma;
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();
  cell(0, 0) = a;
  cell.col(1) << b * cos_gamma, b * sin_gamma, 0.0;
  cell.col(2) << c * cos_beta, c * y, c * std::sqrt(1.0 - cos_beta * cos_beta - y * y);
  return cell;
}

}  // namespace trivalent::dual
