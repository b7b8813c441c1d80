#include "bond_pairs.h"

#include <algorithm>
#include <set>

#include "trivalent/dual/error.h"

namespace trivalent::dual {

std::vector<std::array<int, 2>> bond_pairs(const Structure& structure,
                                           std::vector<std::string>& notes) {
  std::vector<std::array<int, 2>> pairs;
  std::set<std::array<int, 2>> seen;
  for (const potentials::Bond& bond : structure.bonds) {
    const std::array<int, 2> pair = {static_cast<int>(std::min(bond.first, bond.second)),
                                     static_cast<int>(std::max(bond.first, bond.second))};
    if (pair[0] != pair[1] && seen.insert(pair).second) pairs.push_back(pair);
  }
  if (pairs.size() < structure.bonds.size()) {
    notes.push_back(concat(structure.bonds.size() - pairs.size(),
                           " bonds to further images of an atom are left out: the format knows no "
                           "images"));
  }
  return pairs;
}

}  // namespace trivalent::dual
