#include "rebo/gradient.h"

namespace trivalent::potentials::rebo_detail {

Gradient::Gradient(const BondList& bonds, EnergyForces& result)
    : bonds_(bonds),
      result_(result),
      cutoff_(bonds.size(), 0.0),
      coordination_(result.forces.size()) {}

void Gradient::add_separation(std::uint32_t from, std::uint32_t to,
                              const Eigen::Vector3d& separation, const Eigen::Vector3d& slope) {
  result_.forces[from] += slope;
  result_.forces[to] -= slope;
  result_.virial -= slope * separation.transpose();
}

void Gradient::add_coordination_without(std::size_t bond, Coordination slope) {
  add_coordination(bonds_[bond].from, slope);
  add_cutoff(bond, -slope.of(bonds_.species(bonds_[bond].to)));
}

void Gradient::finish() {
  for (std::size_t b = 0; b < bonds_.size(); ++b) {
    const DirectedBond& bond = bonds_[b];
    if (bond.cutoff.slope == 0.0) continue;
    const double slope = cutoff_[b] + coordination_[bond.from].of(bonds_.species(bond.to));
    add_distance(bond, slope * bond.cutoff.slope);
  }
}

}  // namespace trivalent::potentials::rebo_detail
