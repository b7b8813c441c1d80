#include "trivalent/dual/padded_box.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace trivalent::dual {

potentials::Box padded_box(std::span<const Eigen::Vector3d> positions, double padding) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& position : positions) bounds.extend(position);
  if (bounds.isEmpty()) bounds.extend(Eigen::Vector3d::Zero());
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(padding);
  potentials::Box box;
  box.origin = bounds.min() - margin;
  box.cell.diagonal() = bounds.sizes() + 2.0 * margin;
  return box;
}

potentials::Box periodic_box(potentials::Box box, std::span<const Eigen::Vector3d> positions,
                             double padding) {
  for (int k = 0; k < 3; ++k) {
    if (!box.periodic[static_cast<std::size_t>(k)]) box.cell.col(k).setZero();
  }
  for (int k = 0; k < 3; ++k) {
    if (!box.cell.col(k).isZero(0.0)) continue;
    const Eigen::Vector3d next = box.cell.col((k + 1) % 3);
    const Eigen::Vector3d last = box.cell.col((k + 2) % 3);
    // Right-handed, also while one of the others is still to come.
    const Eigen::Vector3d across = next.isZero(0.0)   ? last.unitOrthogonal()
                                   : last.isZero(0.0) ? next.unitOrthogonal()
                                                      : next.cross(last);
    const Eigen::Vector3d direction = across.normalized();
    double low = 0.0;
    double high = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double at = positions[i].dot(direction);
      low = i == 0 ? at : std::min(low, at);
      high = i == 0 ? at : std::max(high, at);
    }
    box.cell.col(k) = (high - low + 2.0 * padding) * direction;
    box.origin += (low - padding - box.origin.dot(direction)) * direction;
  }
  return box;
}

potentials::Box box_to_write(const potentials::Atoms& atoms) {
  const bool is_bare_cluster = !atoms.box.is_periodic() && atoms.box.cell.isZero(0.0);
  if (is_bare_cluster) return padded_box(atoms.positions);
  potentials::Box box = atoms.box;
  if (atoms.size() == 0 || !(std::abs(box.cell.determinant()) > 0.0)) return box;
  const Eigen::Matrix3d inverse = box.cell.inverse();
  Eigen::Array3d low = Eigen::Array3d::Zero();
  Eigen::Array3d high = Eigen::Array3d::Ones();
  for (const Eigen::Vector3d& p : atoms.positions) {
    const Eigen::Array3d fractions = inverse * (p - atoms.box.origin);
    low = low.min(fractions);
    high = high.max(fractions);
  }
  for (int i = 0; i < 3; ++i) {
    if (box.periodic[static_cast<std::size_t>(i)] || (low[i] >= 0.0 && high[i] <= 1.0)) continue;
    const double padding = default_padding / atoms.box.cell.col(i).norm();
    if (low[i] < 0.0) low[i] -= padding;
    if (high[i] > 1.0) high[i] += padding;
    box.origin += low[i] * atoms.box.cell.col(i);
    box.cell.col(i) *= high[i] - low[i];
  }
  return box;
}

}  // namespace trivalent::dual
