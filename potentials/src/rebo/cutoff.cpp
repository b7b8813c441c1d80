#include "rebo/cutoff.h"

#include <cmath>
#include <numbers>

namespace trivalent::potentials::rebo_detail {

ValueAndSlope cosine_switch(double x, Range range) {
  if (x <= range.begin) return {1.0, 0.0};
  if (x >= range.end) return {0.0, 0.0};
  const double rate = std::numbers::pi / (range.end - range.begin);
  const double phase = rate * (x - range.begin);
  return {0.5 * (1.0 + std::cos(phase)), -0.5 * rate * std::sin(phase)};
}

}  // namespace trivalent::potentials::rebo_detail
