#include "trivalent/dual/structure.h"

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

}  // namespace trivalent::dual
