#include "trivalent/potentials/bonds.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "trivalent/potentials/error.h"
#include "trivalent/potentials/neighbor_list.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

// Of the two ways to write a bond: from the atom of lower index, or to the image that comes later.
Bond in_standard_form(const Bond& bond) {
  const Bond back = {bond.second, bond.first, {-bond.image[0], -bond.image[1], -bond.image[2]}};
  if (bond.first != bond.second) return bond.first < bond.second ? bond : back;
  return bond.image < back.image ? back : bond;
}

std::vector<Bond> bonds_of(const NeighborList& neighbors) {
  std::vector<Bond> bonds;
  for (std::uint32_t i = 0; i < neighbors.size(); ++i) {
    for (const Neighbor& neighbor : neighbors[i]) {
      const bool is_second = i == neighbor.atom && neighbor.image < std::array<std::int32_t, 3>{};
      if (neighbor.atom < i || is_second) continue;
      bonds.push_back({i, neighbor.atom, neighbor.image});
    }
  }
  return bonds;
}

}  // namespace

double bond_length(const Atoms& atoms, const Bond& bond) {
  Eigen::Vector3d between = atoms.positions[bond.second] - atoms.positions[bond.first];
  for (int k = 0; k < 3; ++k) {
    const std::int32_t times = bond.image[static_cast<std::size_t>(k)];
    if (times != 0) between += times * atoms.box.cell.col(k);
  }
  return between.norm();
}

std::vector<Bond> bonds_between(const Atoms& atoms, std::span<const std::array<int, 2>> pairs) {
  const auto n = static_cast<std::int64_t>(atoms.size());
  const Eigen::Matrix3d inverse = completed_cell(atoms.box).inverse();
  std::vector<Bond> bonds;
  bonds.reserve(pairs.size());
  for (const auto& [first, second] : pairs) {
    if (first < 0 || second < 0 || first >= n || second >= n) {
      throw InvalidAtoms(concat("bonds_between: there is no bond between atoms ", first, " and ",
                                second, " of ", n, " atoms"));
    }
    Bond bond = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
    const Eigen::Vector3d reduced =
        inverse * (atoms.positions[bond.second] - atoms.positions[bond.first]);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      if (atoms.box.periodic[axis]) {
        bond.image[axis] = static_cast<std::int32_t>(-std::lround(reduced[k]));
      }
    }
    bonds.push_back(bond);
  }
  return bonds;
}

std::vector<Bond> bonds_within(const Atoms& atoms, double cutoff) {
  return bonds_of(NeighborList(atoms, cutoff));
}

BondChanges bond_changes(const Atoms& atoms, std::span<const Bond> bonds, double cutoff) {
  const auto is_before = [](const Bond& a, const Bond& b) {
    return std::tie(a.first, a.second, a.image) < std::tie(b.first, b.second, b.image);
  };
  std::vector<Bond> meant;
  for (const Bond& bond : bonds) meant.push_back(in_standard_form(bond));
  std::sort(meant.begin(), meant.end(), is_before);
  const NeighborList neighbors(atoms, cutoff);
  std::vector<Bond> found = bonds_of(neighbors);
  std::sort(found.begin(), found.end(), is_before);
  BondChanges changes;
  std::set_difference(meant.begin(), meant.end(), found.begin(), found.end(),
                      std::back_inserter(changes.broken), is_before);
  std::set_difference(found.begin(), found.end(), meant.begin(), meant.end(),
                      std::back_inserter(changes.formed), is_before);
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    changes.coordinations.push_back(static_cast<int>(neighbors[i].size()));
  }
  return changes;
}

}  // namespace trivalent::potentials
