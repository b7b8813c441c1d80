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
  HermiteWeights weights;

  CellArgument(double x, int first, int last) : cell(0), weights{} {
    const double inside = std::clamp(x, static_cast<double>(first), static_cast<double>(last));
    const int lower = std::min(static_cast<int>(inside), last - 1);
    cell = static_cast<std::size_t>(lower - first);
    weights = hermite_weights(inside - lower);
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
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t b = 0; b < 2; ++b) {
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
  Value3 sum{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t a = corner & 1;
    const std::size_t b = corner >> 1 & 1;
    const std::size_t c = corner >> 2;
    const Node& node = nodes_[along_x.cell + a][along_y.cell + b][along_z.cell + c];
    // The node's own contribution and its derivatives along one direction at a time.
    const double from_x = node.value * wx.h[a] + node.slope_x * wx.H[a];
    const double from_x_slope = node.value * wx.h_slope[a] + node.slope_x * wx.H_slope[a];
    const double from_y = node.slope_y * wx.h[a];
    const double from_y_slope = node.slope_y * wx.h_slope[a];
    const double from_z = node.slope_z * wx.h[a];
    const double from_z_slope = node.slope_z * wx.h_slope[a];
    const double hy = wy.h[b];
    const double hz = wz.h[c];
    sum.value += (from_x * hy + from_y * wy.H[b]) * hz + from_z * hy * wz.H[c];
    sum.slope_x += (from_x_slope * hy + from_y_slope * wy.H[b]) * hz + from_z_slope * hy * wz.H[c];
    sum.slope_y +=
        (from_x * wy.h_slope[b] + from_y * wy.H_slope[b]) * hz + from_z * wy.h_slope[b] * wz.H[c];
    sum.slope_z += (from_x * hy + from_y * wy.H[b]) * wz.h_slope[c] + from_z * hy * wz.H_slope[c];
  }
  return sum;
}

}  // namespace trivalent::potentials::rebo_detail
