#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace trivalent::dual {

using Polyline = std::vector<Eigen::Vector2d>;

/// A line of text as strokes of a pen.
struct StrokedText {
  std::vector<Polyline> strokes;  ///< x to the right from 0, y up from the baseline
  double width = 0.0;
};

/// Writes UTF-8 text with capitals one unit high. Knows ASCII, Å, ° and −; anything else becomes a
/// box.
[[nodiscard]] StrokedText stroke_text(std::string_view text);

}  // namespace trivalent::dual
