#include "trivalent/dual/structure.h"

#include <algorithm>
#include <utility>

namespace trivalent::dual {

std::vector<std::array<int, 2>> drawable_bonds(const Structure& structure) {
  std::vector<std::array<int, 2>> pairs;
  pairs.reserve(structure.bonds.size());
  for (const potentials::Bond& bond : structure.bonds) {
    if (bond.image != std::array<std::int32_t, 3>{0, 0, 0}) continue;
    pairs.push_back({static_cast<int>(bond.first), static_cast<int>(bond.second)});
  }
  return pairs;
}

std::vector<std::vector<int>> drawable_rings(const Structure& structure) {
  std::vector<std::vector<int>> rings;
  rings.reserve(structure.rings.size());
  for (const Ring& ring : structure.rings) {
    if (!ring.crosses_boundary) rings.push_back(ring.atoms);
  }
  return rings;
}

Structure part_of(const Structure& structure, const std::function<bool(std::size_t)>& is_kept) {
  const potentials::Atoms& atoms = structure.atoms;
  Structure part = {.atoms = {.positions = {}, .species = {}, .box = atoms.box}};
  std::vector<std::uint32_t> places(atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    places[i] = static_cast<std::uint32_t>(part.atoms.size());
    if (!is_kept(i)) continue;
    part.atoms.positions.push_back(atoms.positions[i]);
    part.atoms.species.push_back(atoms.species[i]);
  }
  for (const auto& [first, second, image] : structure.bonds) {
    if (!is_kept(first) || !is_kept(second)) continue;
    part.bonds.push_back({places[first], places[second], image});
  }
  for (Ring ring : structure.rings) {
    if (!std::ranges::all_of(ring.atoms, is_kept)) continue;
    for (int& atom : ring.atoms) atom = static_cast<int>(places[static_cast<std::size_t>(atom)]);
    part.rings.push_back(std::move(ring));
  }
  return part;
}

}  // namespace trivalent::dual
