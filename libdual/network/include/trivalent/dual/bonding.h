#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trivalent/dual/error.h"
#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// A bond as one of its two atoms sees it.
struct BondEnd {
  int atom = 0;                                          ///< at the other end
  std::array<std::int32_t, 3> image = {0, 0, 0};         ///< periodic copy of it, in cell vectors
  Eigen::Vector3d separation = Eigen::Vector3d::Zero();  ///< towards it [Å]
};

/// The bonds of every atom, also across periodic boundaries.
using Bonding = std::vector<std::vector<BondEnd>>;

/// Sorts bonds by atom, keeping their order.
///
/// @throws InvalidNetwork if a bond names an atom that does not exist, or joins one to itself.
[[nodiscard]] Bonding bonding_of(const potentials::Atoms& atoms,
                                 std::span<const potentials::Bond> bonds);
[[nodiscard]] Bonding bonding_of(const Structure& structure);

/// Bonds by distance: two atoms are bonded if they are nearer than the middle of the range over
/// which REBO lets bonds fade out [Brenner2002]: C-C 1.85 Å, C-H 1.55 Å, H-H 1.4 Å. Ordered by
/// atoms and image.
///
/// @throws potentials::InvalidAtoms as potentials::NeighborList.
[[nodiscard]] std::vector<potentials::Bond> find_bonds(const potentials::Atoms& atoms);

/// Number of bonds of every atom.
[[nodiscard]] std::vector<int> coordinations(const Bonding& bonding);

/// Finds the rings of a network from its bonds alone.
///
/// At each angle of an atom of two or three bonds: the shortest ring through both of the bonds that
/// passes by the atom's third neighbor, with at most 12 atoms. An angle lies in one ring; shorter
/// rings are served first. The dual of a triangle mesh gets its own rings back unless they are
/// larger than that. Atoms of more bonds lie in no ring. Rings are ordered by size, then by atoms.
///
/// Cost: O(n) for n atoms.
[[nodiscard]] std::vector<Ring> find_rings(const Bonding& bonding);

/// Finds bonds by distance if there are none, and rings from the bonds if there are none.
///
/// @throws as find_bonds and bonding_of.
void add_missing_network(Structure& structure);

}  // namespace trivalent::dual
