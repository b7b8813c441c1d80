#include "trivalent/dual/check_atoms.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "trivalent/dual/carbon_atoms.h"
#include "trivalent/dual/error.h"

namespace trivalent::dual {

void check_atoms(std::string_view writer, const potentials::Atoms& atoms) {
  if (atoms.species.size() != atoms.positions.size()) {
    throw InvalidNetwork(concat(writer, ": ", atoms.positions.size(), " positions but ",
                                atoms.species.size(), " species; there must be one per atom"));
  }
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    if (atoms.positions[i].allFinite()) continue;
    throw InvalidNetwork(concat(writer, ": atom ", i, " has a coordinate that is not finite"));
  }
}

bool has_hydrogen(const potentials::Atoms& atoms) {
  return std::ranges::find(atoms.species, potentials::Species::hydrogen) != atoms.species.end();
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
