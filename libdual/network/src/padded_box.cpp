#include "trivalent/dual/padded_box.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
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
