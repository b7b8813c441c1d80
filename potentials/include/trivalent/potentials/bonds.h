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

/// Length of a bond [Å].
[[nodiscard]] double bond_length(const Atoms& atoms, const Bond& bond);

/// The bonds between given pairs of atoms, to the nearest image of the second.
///
/// @throws InvalidAtoms if a pair names an atom that does not exist.
[[nodiscard]] std::vector<Bond> bonds_between(const Atoms& atoms,
                                              std::span<const std::array<int, 2>> pairs);

/// The bonds between all atoms nearer than `cutoff` [Å], each once.
///
/// @throws InvalidAtoms, InvalidOption  see NeighborList.
[[nodiscard]] std::vector<Bond> bonds_within(const Atoms& atoms, double cutoff);

/// What became of the bonds of a network.
struct BondChanges {
  std::vector<Bond> broken;        ///< bonds of the network, now longer than the cutoff
  std::vector<Bond> formed;        ///< pairs within the cutoff that have no bond
  std::vector<int> coordinations;  ///< neighbors of each atom within the cutoff
};

/// Where REBO ends the reach of a carbon-carbon bond [Å].
inline constexpr double bond_reach = 2.0;

/// Compares the pairs within a cutoff [Å] with the bonds of a network.
///
/// @throws InvalidAtoms, InvalidOption  see NeighborList.
[[nodiscard]] BondChanges bond_changes(const Atoms& atoms, std::span<const Bond> bonds,
                                       double cutoff = bond_reach);

}  // namespace trivalent::potentials
