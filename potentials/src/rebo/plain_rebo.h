#pragma once

#include "rebo/parameters.h"
#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials::rebo_detail {

/// REBO bond by bond as the formulas stand, one thread: what the fast evaluation is compared with.
///
/// @throws InvalidAtoms as NeighborList does.
[[nodiscard]] EnergyForces plain_rebo(const AtomsView& atoms, const Parameters& parameters);

}  // namespace trivalent::potentials::rebo_detail
