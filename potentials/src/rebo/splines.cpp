#include "rebo/splines.h"

#include <algorithm>

namespace trivalent::potentials::rebo_detail {

namespace {

// Weights of the two ends of a unit interval, and their derivatives: of the value there (h) and of
// the slope there (H). They depend on the distance from the lower end only, so nothing cancels as
// it would in powers of the coordination itself.
struct HermiteWeights {
  std::array<double, 2> h;
  std::array<double, 2> h_slope;
  std::array<double, 2> H;
  std::array<double, 2> H_slope;
};

[[nodiscard]] HermiteWeights hermite_weights(double u) {
  const double v = 1.0 - u;
  return {
      .h = {(1.0 + 2.0 * u) * v * v, u * u * (3.0 - 2.0 * u)},
      .h_slope = {-6.0 * u * v, 6.0 * u * v},
      .H = {u * v * v, -u * u * v},
      .H_slope = {v * (1.0 - 3.0 * u), u * (3.0 * u - 2.0)},
  };
}

// The cell an argument falls into, and where inside.
struct CellArgument {
  std::size_t cell;
  std::size_t ends;  // of the cell that count: at a knot all weights of the other end are zero
  HermiteWeights weights;

  CellArgument(double x, int first, int last) : cell(0), ends(2), weights{} {
    const double inside = std::clamp(x, static_cast<double>(first), static_cast<double>(last));
    const int lower = std::min(static_cast<int>(inside), last - 1);
    cell = static_cast<std::size_t>(lower - first);
    weights = hermite_weights(inside - lower);
    if (inside == lower) ends = 1;
    if (x == inside) return;
    weights.h_slope = {0.0, 0.0};
    weights.H_slope = {0.0, 0.0};
  }
};

}  // namespace

Value2 BicubicSpline::operator()(double x, double y) const {
  const CellArgument along_x(x, 0, 4);
  const CellArgument along_y(y, 0, 4);
  const HermiteWeights& wx = along_x.weights;
  const HermiteWeights& wy = along_y.weights;
  Value2 sum{};
  for (std::size_t a = 0; a < along_x.ends; ++a) {
    for (std::size_t b = 0; b < along_y.ends; ++b) {
      const double knot = values_[along_x.cell + a][along_y.cell + b];
      sum.value += knot * wx.h[a] * wy.h[b];
      sum.slope_x += knot * wx.h_slope[a] * wy.h[b];
      sum.slope_y += knot * wx.h[a] * wy.h_slope[b];
    }
  }
  return sum;
}

Value3 TricubicSpline::operator()(double x, double y, double z) const {
  const CellArgument along_x(x, 0, 4);
  const CellArgument along_y(y, 0, 4);
  const CellArgument along_z(z, 1, 9);
  const HermiteWeights& wx = along_x.weights;
  const HermiteWeights& wy = along_y.weights;
  const HermiteWeights& wz = along_z.weights;
  // One direction after the other: z, then y, then x. What is given at a knot as a slope along one
  // direction counts like a value along the others; names with x and y are about those.
  Value3 sum{};
  for (std::size_t a = 0; a < along_x.ends; ++a) {
    double value = 0.0;
    double slope_y = 0.0;
    double slope_z = 0.0;
    double x_value = 0.0;
    double x_slope_y = 0.0;
    double x_slope_z = 0.0;
    for (std::size_t b = 0; b < along_y.ends; ++b) {
      const Node& low = nodes_[along_x.cell + a][along_y.cell + b][along_z.cell];
      const Node& high = nodes_[along_x.cell + a][along_y.cell + b][along_z.cell + 1];
      const double from_value = low.value * wz.h[0] + high.value * wz.h[1] + low.slope_z * wz.H[0] +
                                high.slope_z * wz.H[1];
      const double from_value_z = low.value * wz.h_slope[0] + high.value * wz.h_slope[1] +
                                  low.slope_z * wz.H_slope[0] + high.slope_z * wz.H_slope[1];
      const double from_y = low.slope_y * wz.h[0] + high.slope_y * wz.h[1];
      const double from_y_z = low.slope_y * wz.h_slope[0] + high.slope_y * wz.h_slope[1];
      const double from_x = low.slope_x * wz.h[0] + high.slope_x * wz.h[1];
      const double from_x_z = low.slope_x * wz.h_slope[0] + high.slope_x * wz.h_slope[1];
      value += from_value * wy.h[b] + from_y * wy.H[b];
      slope_y += from_value * wy.h_slope[b] + from_y * wy.H_slope[b];
      slope_z += from_value_z * wy.h[b] + from_y_z * wy.H[b];
      x_value += from_x * wy.h[b];
      x_slope_y += from_x * wy.h_slope[b];
      x_slope_z += from_x_z * wy.h[b];
    }
    sum.value += value * wx.h[a] + x_value * wx.H[a];
    sum.slope_x += value * wx.h_slope[a] + x_value * wx.H_slope[a];
    sum.slope_y += slope_y * wx.h[a] + x_slope_y * wx.H[a];
    sum.slope_z += slope_z * wx.h[a] + x_slope_z * wx.H[a];
  }
  return sum;
}

}  // namespace trivalent::potentials::rebo_detail
