#include "trivalent/dual/bonding.h"

#include <algorithm>

#include "trivalent/dual/network_checks.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

bool is_home(const BondEnd& end) { return end.image == std::array<int, 3>{0, 0, 0}; }

}  // namespace

Bonding bonding_of(const Network& network) {
  static_cast<void>(check_network(network));
  Bonding bonding(network.positions.size());
  for (const auto& [first, second] : network.bonds) {
    const Eigen::Vector3d separation = network.positions[second] - network.positions[first];
    bonding[first].push_back({.atom = second, .separation = separation});
    bonding[second].push_back({.atom = first, .separation = -separation});
  }
  return bonding;
}

Bonding find_bonding(const potentials::Atoms& atoms) {
  const double widest = potentials::max_bond_length(Species::carbon, Species::carbon);
  const potentials::NeighborList neighbors(atoms, widest);
  Bonding bonding(atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    for (const potentials::Neighbor& neighbor : neighbors[i]) {
      if (neighbor.distance >=
          potentials::max_bond_length(atoms.species[i], atoms.species[neighbor.atom]))
        continue;
      bonding[i].push_back({.atom = static_cast<int>(neighbor.atom),
                            .image = {neighbor.image[0], neighbor.image[1], neighbor.image[2]},
                            .separation = neighbor.separation});
    }
  }
  return bonding;
}

std::vector<int> coordinations(const Bonding& bonding) {
  std::vector<int> counts;
  counts.reserve(bonding.size());
  for (const auto& ends : bonding) counts.push_back(static_cast<int>(ends.size()));
  return counts;
}

Network drawable_network(const potentials::Atoms& atoms, const Bonding& bonding,
                         const std::vector<Ring>& rings) {
  Network network = {.positions = atoms.positions};
  for (std::size_t i = 0; i < bonding.size(); ++i) {
    for (const BondEnd& end : bonding[i]) {
      const int atom = static_cast<int>(i);
      if (is_home(end) && atom < end.atom) network.bonds.push_back({atom, end.atom});
    }
  }
  for (const Ring& ring : rings) {
    if (!ring.crosses_boundary) network.rings.push_back(ring.atoms);
  }
  return network;
}

}  // namespace trivalent::dual
