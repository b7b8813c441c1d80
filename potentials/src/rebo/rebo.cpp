#include "trivalent/potentials/rebo.h"

#include <cmath>

#include "rebo/evaluator.h"
#include "trivalent/potentials/error.h"

namespace trivalent::potentials {

namespace {

[[nodiscard]] double checked_skin(const ReboOptions& options) {
  if (!(options.skin >= 0.0) || !std::isfinite(options.skin)) {
    throw InvalidOption(concat("rebo: skin is ", options.skin, "; it must be >= 0"));
  }
  return options.skin;
}

}  // namespace

Rebo::Rebo(const ReboOptions& options)
    : evaluator_(std::make_unique<rebo_detail::Evaluator>(rebo_detail::brenner_2002,
                                                          checked_skin(options))) {}
Rebo::~Rebo() = default;

void Rebo::forget() { evaluator_->forget(); }

void Rebo::compute(const AtomsView& atoms, EnergyForces& result) {
  evaluator_->evaluate(atoms, result);
}

EnergyForces rebo(const AtomsView& atoms, const ReboOptions& options) {
  (void)checked_skin(options);
  constexpr double no_skin = 0.0;  // neighbors are used once
  rebo_detail::Evaluator evaluator(rebo_detail::brenner_2002, no_skin);
  EnergyForces result;
  evaluator.evaluate(atoms, result);
  return result;
}

}  // namespace trivalent::potentials
