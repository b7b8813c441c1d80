#include "trivalent/view/shell_state.h"

#include <algorithm>
#include <limits>

#include "trivalent/dual/bonding.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/dual/walls.h"

namespace trivalent::dual {
ShellState shell_state(std::string name, Structure structure) {
  add_missing_network(structure);
  ShellState state = {.name = std::move(name), .structure = std::move(structure)};
  state.rings_at_atoms = ring_sizes_at_atoms(state.structure);
  for (const Ring& ring : state.structure.rings) {
    ++state.ring_sizes[static_cast<int>(ring.atoms.size())];
  }
  const Bonding bonding = bonding_of(state.structure);
  state.maps = {ring_size_map(state.rings_at_atoms), coordination_map(bonding),
                bond_strain_map(bonding, state.structure.atoms.species, graphene_bond),
                pyramidalization_map(bonding)};
  if (const auto walls = walls_of(state.structure); !walls.empty()) {
    state.maps.push_back(wall_map(walls));
  }
  return state;
}

void add_energies(ShellState& state, std::span<const double> energies, double reference) {
  if (energies.size() != state.structure.atoms.size()) {
    throw InvalidNetwork(concat("add_energies: ", energies.size(), " energies for ",
                                state.structure.atoms.size(), " atoms"));
  }
  // What an atom of graphene has says nothing about hydrogen.
  std::vector<double> of_carbon(energies.begin(), energies.end());
  for (std::size_t i = 0; i < of_carbon.size(); ++i) {
    if (state.structure.atoms.species[i] != potentials::Species::carbon) {
      of_carbon[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  std::vector<AtomMap> maps = {energy_map(energies, reference), excess_map(of_carbon, reference)};
  maps.front().scale = diverging_scale(of_carbon, reference);
  state.maps.insert(state.maps.begin(), maps.begin(), maps.end());
}

const AtomMap* ShellState::find(std::string_view map) const {
  const auto found = std::find_if(maps.begin(), maps.end(),
                                  [&](const AtomMap& candidate) { return candidate.name == map; });
  return found == maps.end() ? nullptr : &*found;
}

void check_state(std::string_view writer, const ShellState& state) {
  check_atoms(writer, state.structure.atoms);
  static_cast<void>(check_network(state.structure));
  const std::size_t n_atoms = state.structure.atoms.size();
  for (const AtomMap& map : state.maps) {
    if (map.values.size() == n_atoms) continue;
    throw InvalidNetwork(concat(writer, ": map ", map.name, " has ", map.values.size(),
                                " values for ", n_atoms, " atoms"));
  }
}

}  // namespace trivalent::dual
