#include "rebo/angular_function.h"

#include <span>

#include "rebo/cutoff.h"
#include "rebo/parameters.h"
#include "value_and_slope.h"

namespace trivalent::potentials::rebo_detail {

namespace {

[[nodiscard]] ValueAndSlope polynomial(std::span<const AngularPiece> pieces, double cosine) {
  std::size_t piece = 0;
  while (piece + 1 < pieces.size() && cosine >= pieces[piece].end) ++piece;
  ValueAndSlope sum = {0.0, 0.0};
  for (std::size_t n = pieces[piece].c.size(); n-- > 0;) {
    sum.slope = sum.slope * cosine + sum.value;
    sum.value = sum.value * cosine + pieces[piece].c[n];
  }
  return sum;
}

[[nodiscard]] AngularValue angular_function_of_carbon(double cosine, double coordination) {
  const ValueAndSlope few = polynomial(g_carbon_few, cosine);
  if (coordination <= g_carbon_switch.begin) return {few.value, few.slope, 0.0};
  const ValueAndSlope many = polynomial(g_carbon_many, cosine);
  const ValueAndSlope share = cosine_switch(coordination, g_carbon_switch);
  return {many.value + share.value * (few.value - many.value),
          many.slope + share.value * (few.slope - many.slope),
          share.slope * (few.value - many.value)};
}

}  // namespace

AngularValue angular_function(Species center, double cosine, double coordination) {
  if (center == Species::carbon) return angular_function_of_carbon(cosine, coordination);
  const ValueAndSlope g = polynomial(g_hydrogen, cosine);
  return {g.value, g.slope, 0.0};
}

}  // namespace trivalent::potentials::rebo_detail
