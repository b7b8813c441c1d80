#pragma once

#include <map>

#include "trivalent/dual/network.h"

namespace trivalent::dual {

/// What a network looks like. A closed shell on a surface of Euler characteristic χ has coordination 3
/// everywhere and Σ(6 - ring size) = 6χ.
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
  [[nodiscard]] bool is_trivalent() const { return coordinations.size() == 1 && coordinations.contains(3); }
};

[[nodiscard]] NetworkReport check_network(const Network& network);

/// Number of bonds of every atom.
[[nodiscard]] std::vector<int> coordinations(const Network& network);

}  // namespace trivalent::dual
