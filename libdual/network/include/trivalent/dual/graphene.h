#pragma once

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Bond length of graphene at rest under REBO [Å].
inline constexpr double graphene_bond = 1.42039;

/// The rectangular cell of graphene: four atoms in a plane, periodic in x and y. Its energy per
/// atom under a potential is what shells are compared with.
///
/// @param bond  [Å], > 0
[[nodiscard]] potentials::Atoms graphene_cell(double bond = graphene_bond);

}  // namespace trivalent::dual
