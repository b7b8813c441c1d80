#include "ideal_edges.h"

#include <algorithm>

#include "trivalent/dual/error.h"
#include "trivalent/dual/hydrogen.h"
#include "trivalent/dual/network_checks.h"

namespace trivalent::dual {
namespace {

/// Takes away the atoms that have fewer than two bonds.
///
/// @return  Whether there were any.
bool trim(Structure& structure) {
  constexpr int min_bonds = 2;
  const std::vector<int> n_bonds = coordinations(structure);
  std::vector<std::uint32_t> new_index(n_bonds.size(), 0);
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < n_bonds.size(); ++i) {
    new_index[i] = static_cast<std::uint32_t>(kept.size());
    if (n_bonds[i] >= min_bonds) kept.push_back(structure.atoms.positions[i]);
  }
  if (kept.size() == n_bonds.size()) return false;
  structure.atoms.positions = std::move(kept);
  structure.atoms.species.resize(structure.atoms.positions.size());
  std::erase_if(structure.bonds, [&](const potentials::Bond& bond) {
    return n_bonds[bond.first] < min_bonds || n_bonds[bond.second] < min_bonds;
  });
  for (potentials::Bond& bond : structure.bonds) {
    bond.first = new_index[bond.first];
    bond.second = new_index[bond.second];
  }
  return true;
}

}  // namespace

void require_few_atoms(std::string_view structure, double n_atoms) {
  constexpr double max_atoms = 1e7;
  if (n_atoms > max_atoms) {
    throw InvalidOption(concat(structure, ": ", n_atoms, " atoms; at most 10000000 can be made"));
  }
}

void close_edges(Structure& structure, Edges edges) {
  if (edges == Edges::periodic) return;
  std::erase_if(structure.bonds, [](const potentials::Bond& bond) {
    return std::ranges::any_of(bond.image, [](std::int32_t count) { return count != 0; });
  });
  structure.atoms.box = {};
  while (trim(structure)) {
  }
  if (structure.atoms.size() == 0) {
    throw InvalidOption("no atom with two bonds is left between the edges; make it longer");
  }
  if (edges == Edges::hydrogen) cap_with_hydrogen(structure);
}

}  // namespace trivalent::dual
