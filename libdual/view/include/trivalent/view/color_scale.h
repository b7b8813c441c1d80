#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trivalent/dual/error.h"

namespace trivalent::dual {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// Colors from evenly spaced stops; values beyond the ends take the colors of the ends.
struct ColorScale {
  double low = 0.0;           ///< value of the first stop
  double high = 1.0;          ///< value of the last stop, > low
  std::vector<Color> colors;  ///< at least two
  [[nodiscard]] Color color(double value) const;
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// Blue below the center, white at it, red above: readable without red-green vision. Spans from the
/// 2nd to the 98th percentile of the values, whichever is farther from the center, so that a few
/// bad atoms do not wash out all others. Values that are not a number are left out.
///
/// @throws InvalidOption if a value is infinite or the center is not finite.
[[nodiscard]] ColorScale diverging_scale(std::span<const double> values, double center);

/// From dark violet over green to yellow, as light as the value is large: from low to the 98th
/// percentile of the values.
///
/// @throws InvalidOption if a value is infinite or low is not finite.
[[nodiscard]] ColorScale sequential_scale(std::span<const double> values, double low);

}  // namespace trivalent::dual
