#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/network.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/potentials/atoms.h"
#include "trivalent/view/atom_maps.h"

namespace trivalent::dual {

/// Atoms, bonds and rings with everything that is to be seen of them: what pictures, pages and
/// files for viewers are made from.
struct ShellState {
  std::string name;  ///< for people, as in "relaxed"
  potentials::Atoms atoms = {};
  Network network;  ///< bonds and rings to be drawn; positions as in atoms
  std::vector<std::array<int, 3>> rings_at_atoms = {};  ///< as ring_sizes_at_atoms
  std::map<int, int> ring_sizes = {};  ///< rings by size, also those that cannot be drawn
  std::vector<AtomMap> maps = {};      ///< values one per atom
  [[nodiscard]] const AtomMap* find(std::string_view map) const;  ///< null if there is none
};

/// A network's atoms as carbon, with maps of their ring sizes, coordinations, bond strains (against
/// graphene's bond) and curvatures.
///
/// @throws InvalidNetwork as check_network.
[[nodiscard]] ShellState network_state(std::string name, const Network& network);

/// The same for atoms of which only the positions are known: bonds and rings are found.
///
/// @throws potentials::InvalidAtoms as find_bonding.
[[nodiscard]] ShellState atoms_state(std::string name, const potentials::Atoms& atoms);

/// Puts maps of the energies [eV] and of what they are above the reference before all others. The
/// reference and the color scales are carbon's; hydrogen has no energy above it.
///
/// @throws InvalidNetwork if they are not one per atom.
void add_energies(ShellState& state, std::span<const double> energies, double reference);

/// network_columns of a state.
[[nodiscard]] std::vector<Column> network_columns(const ShellState& state);

/// Checks what the writers of states rely on.
///
/// @throws InvalidNetwork if a position is not finite, or species, a map's values or the network's
///   positions are not as many as atoms; the message begins with the writer's name.
void check_state(std::string_view writer, const ShellState& state);

}  // namespace trivalent::dual
