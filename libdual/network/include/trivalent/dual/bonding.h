#pragma once

#include <array>
#include <vector>

#include "trivalent/dual/error.h"
#include "trivalent/dual/network.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// A bond as one of its two atoms sees it.
struct BondEnd {
  int atom = 0;                                          ///< at the other end
  std::array<int, 3> image = {0, 0, 0};                  ///< periodic copy of it, in cell vectors
  Eigen::Vector3d separation = Eigen::Vector3d::Zero();  ///< towards it [Å]
};

/// Who is bonded to whom: the bonds of every atom, also across periodic boundaries.
using Bonding = std::vector<std::vector<BondEnd>>;

/// The bonds of a network, whatever their lengths.
///
/// @throws InvalidNetwork as check_network.
[[nodiscard]] Bonding bonding_of(const Network& network);

/// Bonds by distance: two atoms are bonded if they are nearer than the middle of the range over
/// which REBO lets bonds fade out [Brenner2002]: C-C 1.85 Å, C-H 1.55 Å, H-H 1.4 Å.
///
/// @throws potentials::InvalidAtoms as potentials::NeighborList.
[[nodiscard]] Bonding find_bonding(const potentials::Atoms& atoms);

/// Number of bonds of every atom.
[[nodiscard]] std::vector<int> coordinations(const Bonding& bonding);

/// Atoms in order around a ring, each with its periodic copy.
struct Ring {
  std::vector<int> atoms;
  bool crosses_boundary = false;  ///< of a periodic box
};

/// Finds the rings of a network from its bonds alone.
///
/// At each angle of an atom of two or three bonds: the shortest ring through both of the bonds that
/// passes by the atom's third neighbor, with at most 12 atoms. An angle lies in one ring; shorter
/// rings are served first. The dual of a triangle mesh gets its own rings back unless they are
/// larger than that. Atoms of more bonds lie in no ring. Rings are ordered by size, then by atoms.
///
/// Cost: O(n) for n atoms.
[[nodiscard]] std::vector<Ring> find_rings(const Bonding& bonding);

/// Atoms with what find_bonding and find_rings say of them: only bonds and rings that do not cross
/// a periodic boundary, since those are the ones that can be drawn.
[[nodiscard]] Network drawable_network(const potentials::Atoms& atoms, const Bonding& bonding,
                                       const std::vector<Ring>& rings);

}  // namespace trivalent::dual
