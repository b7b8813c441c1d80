#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "trivalent/dual/bonding.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Two atoms (or an atom and a periodic image of one) and how far they are apart.
struct AtomPair {
  std::array<int, 2> atoms;  ///< from 0
  double distance;           ///< [Å]
};

/// An angle between two bonds of an atom.
struct BondAngle {
  int atom;      ///< in the middle, from 0
  double angle;  ///< [degree]
};

/// How far pairs that are not bonded are looked for [Å]; second neighbors in a hexagon have 2.46.
inline constexpr double non_bonded_reach = 3.0;

/// What atoms form: the topology and geometry of a shell.
struct ShellReport {
  int atoms = 0;
  int bonds = 0;
  int pieces = 0;  ///< atoms that no chain of bonds connects are in different ones
  std::map<int, int> coordinations;         ///< atoms by number of bonds
  std::map<int, int> ring_sizes;            ///< rings by size
  int angles_without_ring = 0;              ///< pairs of bonds at an atom that no ring goes through
  std::optional<AtomPair> shortest_bond;    ///< of two carbons; none if no carbons are bonded
  std::optional<AtomPair> longest_bond;     ///< likewise
  std::optional<BondAngle> smallest_angle;  ///< of any bonds; none if no atom has two
  std::optional<BondAngle> largest_angle;
  std::optional<AtomPair> closest_non_bonded;  ///< two carbons within non_bonded_reach, if any
  /// Atoms that have another number of bonds than they should (carbon 3, hydrogen 1), ascending.
  std::vector<int> odd_atoms;

  /// Every carbon atom has three bonds, and rings go through all pairs of them: a closed surface.
  [[nodiscard]] bool is_closed() const {
    return odd_atoms.empty() && coordinations.size() == 1 && angles_without_ring == 0;
  }
  /// Of a closed surface.
  [[nodiscard]] int euler_characteristic() const { return atoms - bonds + ring_count(); }
  [[nodiscard]] int ring_count() const;
};

/// Looks at atoms as a shell.
///
/// @throws potentials::InvalidAtoms as potentials::NeighborList.
[[nodiscard]] ShellReport check_shell(const potentials::Atoms& atoms, const Bonding& bonding,
                                      const std::vector<Ring>& rings);

}  // namespace trivalent::dual
