#include "trivalent/view/shell_state.h"

#include <algorithm>
#include <limits>

#include "trivalent/dual/bonding.h"
#include "trivalent/dual/carbon_atoms.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/network_checks.h"

namespace trivalent::dual {
namespace {

std::vector<AtomMap> network_maps(const potentials::Atoms& atoms, const Bonding& bonding,
                                  const std::vector<std::array<int, 3>>& ring_sizes) {
  return {ring_size_map(ring_sizes), coordination_map(bonding),
          bond_strain_map(bonding, atoms.species, graphene_bond), pyramidalization_map(bonding)};
}

}  // namespace

ShellState network_state(std::string name, const Network& network) {
  ShellState state = {.name = std::move(name),
                      .atoms = carbon_atoms(network),
                      .network = network,
                      .rings_at_atoms = ring_sizes_at_atoms(network),
                      .ring_sizes = check_network(network).ring_sizes,
                      .maps = {}};
  state.maps = network_maps(state.atoms, bonding_of(network), state.rings_at_atoms);
  return state;
}

ShellState atoms_state(std::string name, const potentials::Atoms& atoms) {
  const Bonding bonding = find_bonding(atoms);
  const std::vector<Ring> rings = find_rings(bonding);
  ShellState state = {.name = std::move(name),
                      .atoms = atoms,
                      .network = drawable_network(atoms, bonding, rings),
                      .maps = {}};
  std::vector<std::vector<int>> atoms_of_rings;
  for (const Ring& ring : rings) {
    atoms_of_rings.push_back(ring.atoms);
    ++state.ring_sizes[static_cast<int>(ring.atoms.size())];
  }
  state.rings_at_atoms = ring_sizes_at_atoms(atoms_of_rings, atoms.size());
  state.maps = network_maps(atoms, bonding, state.rings_at_atoms);
  return state;
}

void add_energies(ShellState& state, std::span<const double> energies, double reference) {
  if (energies.size() != state.atoms.size()) {
    throw InvalidNetwork(
        concat("add_energies: ", energies.size(), " energies for ", state.atoms.size(), " atoms"));
  }
  // What an atom of graphene has says nothing about hydrogen.
  std::vector<double> of_carbon(energies.begin(), energies.end());
  for (std::size_t i = 0; i < of_carbon.size(); ++i) {
    if (state.atoms.species[i] != potentials::Species::carbon) {
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

std::vector<Column> network_columns(const ShellState& state) {
  const auto& counts = state.find("coordination")->values;
  return {{.name = "coordination", .values = std::vector<int>(counts.begin(), counts.end())},
          {.name = "rings", .values = state.rings_at_atoms}};
}

void check_state(std::string_view writer, const ShellState& state) {
  check_atoms(writer, state.atoms);
  static_cast<void>(check_network(state.network));
  const std::size_t n_atoms = state.atoms.size();
  if (state.network.positions.size() != n_atoms) {
    throw InvalidNetwork(concat(writer, ": the network has ", state.network.positions.size(),
                                " positions for ", n_atoms, " atoms"));
  }
  for (const AtomMap& map : state.maps) {
    if (map.values.size() == n_atoms) continue;
    throw InvalidNetwork(concat(writer, ": map ", map.name, " has ", map.values.size(),
                                " values for ", n_atoms, " atoms"));
  }
}

}  // namespace trivalent::dual
