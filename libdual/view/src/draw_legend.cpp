#include "draw_legend.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace trivalent::dual {
namespace {

/// As many decimals as the scale's ends need to be told apart.
std::string number(double value, const ColorScale& scale) {
  const double decimals = 2.0 - std::floor(std::log10(scale.high - scale.low));
  std::ostringstream text;
  text << std::fixed << std::setprecision(static_cast<int>(std::clamp(decimals, 0.0, 6.0)))
       << value;
  return text.str();
}

void draw_scale(FlatDrawing& drawing, const ColorScale& scale, const Pen& pen,
                const Rectangle& bar) {
  drawing.fill(bar, scale);
  const double values[] = {scale.low, scale.middle(), scale.high};
  for (int i = 0; i < 3; ++i) {
    const double x = bar.left + 0.5 * i * bar.width;
    drawing.fill({.left = x - 0.04 * pen.size,
                  .top = bar.top,
                  .width = 0.08 * pen.size,
                  .height = 1.4 * pen.size},
                 pen.ink);
    drawing.write_centered(number(values[i], scale), x, bar.top + 2.7 * pen.size, pen.ink);
  }
}

void draw_swatches(FlatDrawing& drawing, const std::vector<Category>& categories, const Pen& pen,
                   const Eigen::Vector2d& middle) {
  const auto width_of = [&](const Category& category) {
    return 3.2 * pen.size + drawing.text_width(category.label);
  };
  double width = 0.0;
  for (const Category& category : categories) width += width_of(category);
  const double side = 1.2 * pen.size;
  const double rim = 0.08 * pen.size;
  double x = middle.x() - 0.5 * width;
  for (const Category& category : categories) {
    drawing.fill({.left = x, .top = middle.y(), .width = side, .height = side}, pen.ink);
    drawing.fill({.left = x + rim,
                  .top = middle.y() + rim,
                  .width = side - 2.0 * rim,
                  .height = side - 2.0 * rim},
                 category.color);
    drawing.write(category.label, x + 1.7 * pen.size, middle.y() + 1.1 * pen.size, pen.ink);
    x += width_of(category);
  }
}

}  // namespace

void draw_legend(FlatDrawing& drawing, const AtomMap& map, const Pen& pen, const Rectangle& area) {
  drawing.clip(area);
  const double middle = area.left + 0.5 * area.width;
  const std::string title = map.unit.empty() ? map.title : map.title + " [" + map.unit + "]";
  drawing.write_centered(title, middle, area.top + 1.6 * pen.size, pen.ink);
  if (!map.categories.empty()) {
    draw_swatches(drawing, map.categories, pen, {middle, area.top + 3.0 * pen.size});
    return;
  }
  const double width = std::min(0.7 * area.width, 26.0 * pen.size);
  draw_scale(drawing, map.scale, pen,
             {.left = middle - 0.5 * width,
              .top = area.top + 2.6 * pen.size,
              .width = width,
              .height = 1.1 * pen.size});
}

}  // namespace trivalent::dual
