#include "rebo/pair_terms.h"

#include <cmath>

namespace trivalent::potentials::rebo_detail {

namespace {

[[nodiscard]] ValueAndSlope product(ValueAndSlope a, ValueAndSlope b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}

}  // namespace

ValueAndSlope repulsion(double r, ValueAndSlope cutoff, const BondParameters& bond) {
  const double decay = bond.A * std::exp(-bond.alpha * r);
  const double screening = 1.0 + bond.Q / r;
  const ValueAndSlope uncut = {screening * decay,
                               -(bond.alpha * screening + bond.Q / (r * r)) * decay};
  return product(cutoff, uncut);
}

ValueAndSlope attraction(double r, ValueAndSlope cutoff, const BondParameters& bond) {
  ValueAndSlope uncut = {0.0, 0.0};
  for (std::size_t n = 0; n < bond.B.size(); ++n) {
    const double term = bond.B[n] == 0.0 ? 0.0 : bond.B[n] * std::exp(-bond.beta[n] * r);
    uncut.value += term;
    uncut.slope -= bond.beta[n] * term;
  }
  return product(cutoff, uncut);
}

}  // namespace trivalent::potentials::rebo_detail
