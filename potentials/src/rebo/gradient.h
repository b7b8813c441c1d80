#pragma once

#include <vector>

#include "rebo/bond_list.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials::rebo_detail {

/// Gathers dE/d(separation) of pairs, dE/df of bonds and dE/dN of atoms, and turns them into
/// forces.
///
/// Energies depend on coordinations through many bonds of many neighbors. Instead of following each
/// of these paths to positions, the derivatives are added up where the paths meet, and each bond is
/// turned into a force once, at the end.
class Gradient {
 public:
  Gradient(const BondList& bonds, EnergyForces& result);

  /// Adds dE/d(separation) of the pair of atoms (from, to) [eV/Å].
  void add_separation(std::uint32_t from, std::uint32_t to, const Eigen::Vector3d& separation,
                      const Eigen::Vector3d& slope);
  void add_separation(const DirectedBond& bond, const Eigen::Vector3d& slope) {
    add_separation(bond.from, bond.to, bond.separation, slope);
  }

  /// Adds dE/dr of a bond [eV/Å].
  void add_distance(const DirectedBond& bond, double slope) {
    add_separation(bond, slope / bond.distance * bond.separation);
  }

  /// Adds dE/df of one direction of a bond [eV].
  void add_cutoff(std::size_t bond, double slope) { cutoff_[bond] += slope; }

  /// Adds dE/dN of an atom, for its carbon and its hydrogen neighbors [eV].
  void add_coordination(std::uint32_t atom, const Coordination& slope) {
    coordination_[atom].carbon += slope.carbon;
    coordination_[atom].hydrogen += slope.hydrogen;
  }

  /// The same for the coordination of bond.from without bond.to.
  void add_coordination_without(std::size_t bond, Coordination slope);

  /// Turns dE/df and dE/dN into forces; to be called once, last.
  void finish();

 private:
  const BondList& bonds_;
  EnergyForces& result_;
  std::vector<double> cutoff_;              // per bond
  std::vector<Coordination> coordination_;  // per atom
};

}  // namespace trivalent::potentials::rebo_detail
