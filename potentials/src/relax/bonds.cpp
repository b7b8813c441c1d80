#include "trivalent/potentials/bonds.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "rebo/parameters.h"
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

Eigen::Vector3d bond_vector(const Atoms& atoms, const Bond& bond) {
  return atoms.box.shifted(atoms.positions[bond.second] - atoms.positions[bond.first], bond.image);
}

double bond_length(const Atoms& atoms, const Bond& bond) { return bond_vector(atoms, bond).norm(); }

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

double bond_reach(Species a, Species b) { return rebo_detail::brenner_2002.bond(a, b).cutoff.end; }

double max_bond_length(Species a, Species b) {
  const auto [begin, end] = rebo_detail::brenner_2002.bond(a, b).cutoff;
  return 0.5 * (begin + end);
}

int max_bonds(Species species) { return species == Species::carbon ? 4 : 1; }

GuessedBonds guess_bonds(const Atoms& atoms) {
  const double longest = max_bond_length(Species::carbon, Species::carbon);
  std::vector<std::pair<double, Bond>> pairs;
  for (const Bond& bond : bonds_of(NeighborList(atoms, longest))) {
    const double length = bond_length(atoms, bond);
    if (length < max_bond_length(atoms.species[bond.first], atoms.species[bond.second])) {
      pairs.emplace_back(length, bond);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  GuessedBonds guess;
  std::vector<int> counts(atoms.size(), 0);
  const auto is_full = [&](std::uint32_t atom) {
    return counts[atom] >= max_bonds(atoms.species[atom]);
  };
  for (const auto& [length, bond] : pairs) {
    if (is_full(bond.first) || is_full(bond.second)) {
      guess.ambiguous.push_back(bond);
      continue;
    }
    ++counts[bond.first];
    ++counts[bond.second];
    guess.bonds.push_back(bond);
  }
  return guess;
}

BondChanges bond_changes(const Atoms& atoms, std::span<const Bond> bonds) {
  const auto is_before = [](const Bond& a, const Bond& b) {
    return std::tie(a.first, a.second, a.image) < std::tie(b.first, b.second, b.image);
  };
  std::vector<Bond> meant;
  for (const Bond& bond : bonds) meant.push_back(in_standard_form(bond));
  std::sort(meant.begin(), meant.end(), is_before);
  std::vector<Bond> found = bonds_of(NeighborList(atoms, rebo_detail::longest_bond));
  std::erase_if(found, [&](const Bond& bond) {
    return bond_length(atoms, bond) >=
           bond_reach(atoms.species[bond.first], atoms.species[bond.second]);
  });
  std::sort(found.begin(), found.end(), is_before);
  BondChanges changes;
  std::set_difference(meant.begin(), meant.end(), found.begin(), found.end(),
                      std::back_inserter(changes.broken), is_before);
  std::set_difference(found.begin(), found.end(), meant.begin(), meant.end(),
                      std::back_inserter(changes.formed), is_before);
  changes.coordinations.assign(atoms.size(), 0);
  for (const Bond& bond : found) {
    ++changes.coordinations[bond.first];
    ++changes.coordinations[bond.second];
  }
  return changes;
}

}  // namespace trivalent::potentials
