#include "trivalent/potentials/rebo.h"

#include <cmath>

#include "rebo/plain_rebo.h"
#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials {

EnergyForces rebo(const Atoms& atoms, const ReboOptions& options) {
  require_valid(atoms, "rebo");
  if (!(options.skin >= 0.0) || !std::isfinite(options.skin)) {
    throw InvalidOption(concat("rebo: skin is ", options.skin, "; it must be >= 0"));
  }
  return rebo_detail::plain_rebo(atoms, rebo_detail::brenner_2002);
}

}  // namespace trivalent::potentials
