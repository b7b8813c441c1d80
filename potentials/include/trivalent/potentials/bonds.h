#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials {

/// A bond of a network: two atoms, one of them possibly a periodic image.
struct Bond {
  std::uint32_t first;
  std::uint32_t second;
  std::array<std::int32_t, 3> image = {0, 0, 0};  ///< `second` sits at position + cell · image
};

/// From the first atom of a bond to the second [Å].
[[nodiscard]] Eigen::Vector3d bond_vector(const Atoms& atoms, const Bond& bond);

/// Length of a bond [Å].
[[nodiscard]] double bond_length(const Atoms& atoms, const Bond& bond);

/// Distance at which REBO's bond between two elements ends [Å]: C-C 2, C-H 1.8, H-H 1.7
/// [Brenner2002, Table 2].
[[nodiscard]] double bond_reach(Species a, Species b);

/// Atoms closer than this count as bonded [Å]: the middle of the range over which REBO lets a bond
/// fade out. C-C 1.85, C-H 1.55, H-H 1.4.
[[nodiscard]] double max_bond_length(Species a, Species b);

/// Maximum number of bonds of an atom: carbon 4, hydrogen 1.
[[nodiscard]] int max_bonds(Species species);

/// The bonds between given pairs of atoms, to the nearest image of the second.
///
/// @throws InvalidAtoms if a pair names an atom that does not exist.
[[nodiscard]] std::vector<Bond> bonds_between(const Atoms& atoms,
                                              std::span<const std::array<int, 2>> pairs);

/// The bonds between all atoms nearer than `cutoff` [Å], each once.
///
/// @throws InvalidAtoms, InvalidOption  see NeighborList.
[[nodiscard]] std::vector<Bond> bonds_within(const Atoms& atoms, double cutoff);

/// Bonds that distances suggest.
struct GuessedBonds {
  std::vector<Bond> bonds;
  std::vector<Bond> ambiguous;  ///< pairs as close as bonds, of atoms that have all their bonds
};

/// Guesses bonds from distances: pairs closer than max_bond_length(), the shortest first, up to
/// max_bonds() of each atom.
///
/// @throws InvalidAtoms  see NeighborList.
[[nodiscard]] GuessedBonds guess_bonds(const Atoms& atoms);

/// What became of the bonds of a network.
struct BondChanges {
  std::vector<Bond> broken;        ///< bonds of the network, now out of reach
  std::vector<Bond> formed;        ///< pairs within reach that have no bond
  std::vector<int> coordinations;  ///< neighbors of each atom within reach
};

/// Compares the pairs within bond_reach() with the bonds of a network.
///
/// @throws InvalidAtoms  see NeighborList.
[[nodiscard]] BondChanges bond_changes(const Atoms& atoms, std::span<const Bond> bonds);

}  // namespace trivalent::potentials
