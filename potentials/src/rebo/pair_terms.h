#pragma once

#include "rebo/parameters.h"
#include "value_and_slope.h"

namespace trivalent::potentials::rebo_detail {

/// V_R(r) = f(r) (1 + Q/r) A exp(-αr), [Brenner2002, eq. 5] [eV]; f(r) is `cutoff`.
[[nodiscard]] ValueAndSlope repulsion(double r, ValueAndSlope cutoff, const BondParameters& bond);

/// V_A(r) = f(r) Σ B_n exp(-β_n r), [Brenner2002, eq. 6] [eV]; it enters energies with a minus.
[[nodiscard]] ValueAndSlope attraction(double r, ValueAndSlope cutoff, const BondParameters& bond);

}  // namespace trivalent::potentials::rebo_detail
