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

}  // namespace

AngularShapes angular_shapes(Species center, double cosine, double coordination) {
  if (center == Species::hydrogen) return {polynomial(g_hydrogen, cosine), {}};
  const bool is_few = coordination <= g_carbon_switch.begin;
  return {polynomial(g_carbon_few, cosine),
          is_few ? ValueAndSlope{} : polynomial(g_carbon_many, cosine)};
}

ValueAndSlope share_of_few(Species center, double coordination) {
  if (center != Species::carbon) return {1.0, 0.0};
  return cosine_switch(coordination, g_carbon_switch);
}

AngularValue angular_function(Species center, double cosine, double coordination) {
  return blended(angular_shapes(center, cosine, coordination), share_of_few(center, coordination));
}

}  // namespace trivalent::potentials::rebo_detail
