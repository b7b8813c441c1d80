#include "trivalent/view/color_scale.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace trivalent::dual {
namespace {

// The ends and the middle of ColorBrewer's RdBu, which stays readable without red-green vision.
const std::vector<Color> blue_white_red = {
    {33, 102, 172}, {146, 197, 222}, {247, 247, 247}, {244, 165, 130}, {178, 24, 43}};
// Stops of matplotlib's viridis, which is as even in grey as in color.
const std::vector<Color> violet_green_yellow = {{68, 1, 84},    {71, 45, 123},  {59, 82, 139},
                                                {44, 114, 142}, {33, 145, 140}, {40, 174, 128},
                                                {94, 201, 98},  {173, 220, 48}, {253, 231, 37}};

Color blend(const Color& from, const Color& to, double fraction) {
  Color color = {};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = static_cast<std::uint8_t>(std::lround(std::lerp(from[i], to[i], fraction)));
  }
  return color;
}

/// All numbers among the values, in order.
std::vector<double> sorted_numbers(std::span<const double> values, double anchor) {
  const auto is_infinite = [](double value) { return std::isinf(value); };
  if (!std::isfinite(anchor) || std::any_of(values.begin(), values.end(), is_infinite)) {
    throw InvalidOption("color scale: values and where the scale begins must be finite");
  }
  std::vector<double> sorted;
  sorted.reserve(values.size());
  for (const double value : values) {
    if (!std::isnan(value)) sorted.push_back(value);
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double percentile(const std::vector<double>& sorted, double fraction) {
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(position))];
}

constexpr double few = 0.02;
constexpr double any_width = 1.0;  // equal values leave no width; any will do

}  // namespace

Color ColorScale::color(double value) const {
  assert(colors.size() >= 2 && high > low);
  const double last = static_cast<double>(colors.size() - 1);
  const double position = std::clamp((value - low) / (high - low), 0.0, 1.0) * last;
  const double stop = std::min(std::floor(position), last - 1.0);
  const auto i = static_cast<std::size_t>(stop);
  return blend(colors[i], colors[i + 1], position - stop);
}

ColorScale diverging_scale(std::span<const double> values, double center) {
  const std::vector<double> sorted = sorted_numbers(values, center);
  double width = 0.0;
  if (!sorted.empty()) {
    width = std::max(center - percentile(sorted, few), percentile(sorted, 1.0 - few) - center);
  }
  if (!(width > 0.0)) width = any_width;
  return {.low = center - width, .high = center + width, .colors = blue_white_red};
}

ColorScale sequential_scale(std::span<const double> values, double low) {
  const std::vector<double> sorted = sorted_numbers(values, low);
  double high = sorted.empty() ? low : percentile(sorted, 1.0 - few);
  if (!(high > low)) high = low + any_width;
  return {.low = low, .high = high, .colors = violet_green_yellow};
}

}  // namespace trivalent::dual
