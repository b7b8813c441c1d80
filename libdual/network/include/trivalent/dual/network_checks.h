#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "trivalent/dual/structure.h"

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
/// @throws InvalidNetwork as check_bonds, or if a ring names an atom that does not exist.
[[nodiscard]] NetworkReport check_network(const Structure& structure);

/// Refuses bonds that cannot be.
///
/// @throws InvalidNetwork if a bond names an atom that does not exist, or joins one to itself.
void check_bonds(const potentials::Atoms& atoms, std::span<const potentials::Bond> bonds);

/// Number of bonds of every atom.
///
/// @throws InvalidNetwork as check_bonds.
[[nodiscard]] std::vector<int> coordinations(const Structure& structure);

/// Sizes of the rings around every atom, largest first. An atom of a trivalent network lies in
/// three rings; 0 stands for each ring that the edge of an open network has cut.
///
/// @throws InvalidNetwork if a ring names an atom that does not exist, or an atom lies in more than
///   three rings.
[[nodiscard]] std::vector<std::array<int, 3>> ring_sizes_at_atoms(const Structure& structure);

}  // namespace trivalent::dual
