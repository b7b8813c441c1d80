#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/view/atom_maps.h"

namespace trivalent::dual {

/// A structure with everything that is to be seen of it: what pictures, pages and files for viewers
/// are made from.
struct ShellState {
  std::string name;  ///< for people, as in "relaxed"
  Structure structure = {};
  std::vector<std::array<int, 3>> rings_at_atoms = {};            ///< as ring_sizes_at_atoms
  std::map<int, int> ring_sizes = {};                             ///< rings by size
  std::vector<AtomMap> maps = {};                                 ///< values one per atom
  [[nodiscard]] const AtomMap* find(std::string_view map) const;  ///< null if there is none
};

/// Maps of a structure's ring sizes, coordinations, bond strains (against graphene's bond) and
/// curvatures, and of its walls if it has several; bonds and rings are found where they are not
/// known.
///
/// @throws InvalidNetwork         as check_network.
/// @throws potentials::InvalidAtoms as find_bonds.
[[nodiscard]] ShellState shell_state(std::string name, Structure structure);

/// Puts maps of the energies [eV] and of what they are above the reference before all others. The
/// reference and the color scales are carbon's; hydrogen has no energy above it.
///
/// @throws InvalidNetwork if they are not one per atom.
void add_energies(ShellState& state, std::span<const double> energies, double reference);

/// Checks what the writers of states rely on.
///
/// @throws InvalidNetwork if a position is not finite, species or a map's values are not as many as
///   atoms, or as check_network; the message begins with the writer's name.
void check_state(std::string_view writer, const ShellState& state);

}  // namespace trivalent::dual
