#include "trivalent/dual/carbon_atoms.h"

#include <Eigen/Geometry>
#include <algorithm>

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

potentials::Atoms carbon_atoms(const Network& network) {
  potentials::Atoms atoms;
  atoms.positions = network.positions;
  atoms.species.assign(network.positions.size(), potentials::Species::carbon);
  std::fill(atoms.species.end() - network.hydrogens, atoms.species.end(),
            potentials::Species::hydrogen);
  atoms.box = padded_box(network.positions);
  return atoms;
}

}  // namespace trivalent::dual
