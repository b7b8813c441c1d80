#include "trivalent/dual/bonding.h"

#include <algorithm>

#include "trivalent/dual/network_checks.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::dual {
namespace {

using potentials::Bond;
using potentials::Species;

}  // namespace

Bonding bonding_of(const potentials::Atoms& atoms, std::span<const Bond> bonds) {
  check_bonds(atoms, bonds);
  Bonding bonding(atoms.size());
  for (const auto& [first, second, image] : bonds) {
    const Eigen::Vector3d separation = bond_vector(atoms, {first, second, image});
    const std::array<std::int32_t, 3> back = {-image[0], -image[1], -image[2]};
    bonding[first].push_back(
        {.atom = static_cast<int>(second), .image = image, .separation = separation});
    bonding[second].push_back(
        {.atom = static_cast<int>(first), .image = back, .separation = -separation});
  }
  return bonding;
}

Bonding bonding_of(const Structure& structure) {
  return bonding_of(structure.atoms, structure.bonds);
}

std::vector<Bond> find_bonds(const potentials::Atoms& atoms) {
  const double widest = potentials::max_bond_length(Species::carbon, Species::carbon);
  std::vector<Bond> bonds = potentials::bonds_within(atoms, widest);
  std::erase_if(bonds, [&](const Bond& bond) {
    return potentials::bond_length(atoms, bond) >=
           potentials::max_bond_length(atoms.species[bond.first], atoms.species[bond.second]);
  });
  return bonds;
}

std::vector<int> coordinations(const Bonding& bonding) {
  std::vector<int> counts;
  counts.reserve(bonding.size());
  for (const auto& ends : bonding) counts.push_back(static_cast<int>(ends.size()));
  return counts;
}

void add_missing_network(Structure& structure) {
  if (structure.bonds.empty()) structure.bonds = find_bonds(structure.atoms);
  if (structure.rings.empty()) structure.rings = find_rings(bonding_of(structure));
}

}  // namespace trivalent::dual
