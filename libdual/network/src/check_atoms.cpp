#include "trivalent/dual/check_atoms.h"

#include <algorithm>

#include "trivalent/dual/error.h"

namespace trivalent::dual {

void check_atoms(std::string_view writer, const potentials::Atoms& atoms) {
  if (atoms.species.size() != atoms.positions.size()) {
    throw InvalidNetwork(concat(writer, ": ", atoms.positions.size(), " positions but ",
                                atoms.species.size(), " species; there must be one per atom"));
  }
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    if (atoms.positions[i].allFinite()) continue;
    throw InvalidNetwork(concat(writer, ": atom ", i, " has a coordinate that is not finite"));
  }
}

bool has_hydrogen(const potentials::Atoms& atoms) {
  return std::ranges::find(atoms.species, potentials::Species::hydrogen) != atoms.species.end();
}

}  // namespace trivalent::dual
