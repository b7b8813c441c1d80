#pragma once

#include <array>
#include <map>
#include <vector>

#include "trivalent/dual/network.h"

namespace trivalent::dual {

/// What a network looks like. A closed shell on a surface of Euler characteristic χ has
/// coordination 3 everywhere and Σ(6 - ring size) = 6χ.
struct NetworkReport {
  int atoms = 0;
  int bonds = 0;
  int rings = 0;
  std::map<int, int> coordinations;  ///< atoms by number of bonds
  std::map<int, int> ring_sizes;     ///< rings by size
  double hexagon_fraction = 0.0;     ///< rings of 6 / rings; 0 if none
  int ring_excess = 0;               ///< Σ(6 - ring size)
  double bond_mean = 0.0;            ///< [Å]
  double bond_spread = 0.0;          ///< standard deviation [Å]
  double bond_min = 0.0;             ///< [Å]
  double bond_max = 0.0;             ///< [Å]
  /// Every atom has three bonds.
  [[nodiscard]] bool is_trivalent() const {
    return coordinations.size() == 1 && coordinations.contains(3);
  }
};

/// Counts and measures a network; bond lengths are 0 without bonds.
///
/// @throws InvalidNetwork if a bond or ring names an atom that does not exist, or a bond joins an
/// atom
///   to itself.
[[nodiscard]] NetworkReport check_network(const Network& network);

/// Number of bonds of every atom.
///
/// @throws InvalidNetwork as check_network.
[[nodiscard]] std::vector<int> coordinations(const Network& network);

/// Sizes of the rings around every atom, largest first. An atom of a trivalent network lies in
/// three rings; 0 stands for each ring that the edge of an open network has cut.
///
/// @throws InvalidNetwork as check_network, or if an atom lies in more than three rings.
[[nodiscard]] std::vector<std::array<int, 3>> ring_sizes_at_atoms(const Network& network);

/// The same for rings of n_atoms atoms, all of which must exist.
[[nodiscard]] std::vector<std::array<int, 3>> ring_sizes_at_atoms(
    const std::vector<std::vector<int>>& rings, std::size_t n_atoms);

}  // namespace trivalent::dual
