#pragma once

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// Length of a C-H bond at the edge of graphene [Å].
inline constexpr double hydrogen_bond_length = 1.09;

/// What cap_with_hydrogen did.
struct HydrogenCaps {
  int hydrogens = 0;   ///< added
  int bare_atoms = 0;  ///< carbon atoms without any bond, left as they are
};

/// Puts hydrogen on the carbon atoms at the edge of an open network: one on an atom of two bonds,
/// in their plane and on the line that halves the outer angle; two on an atom of one bond, at 120°
/// to it and in the plane of its neighbor. The new atoms come last, in the order of their carbon
/// atoms.
///
/// @throws InvalidNetwork as check_network, or if there is hydrogen already.
HydrogenCaps cap_with_hydrogen(Structure& structure);

/// The carbon atoms with the bonds and rings between them, in the same order; columns stay behind.
[[nodiscard]] Structure without_hydrogen(const Structure& structure);

}  // namespace trivalent::dual
