#include <cmath>
#include <numbers>
#include <utility>

#include "sources/built_in_shapes.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

struct SheetWaves {
  double amplitude = 0.0;
  double wave_number = 0.0;
  [[nodiscard]] double height(double x, double y) const {
    return amplitude * std::sin(wave_number * x) * std::sin(wave_number * y);
  }
  /// Area over one wavelength squared, relative to the flat one.
  [[nodiscard]] double stretch() const {
    constexpr int samples = 64;
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
      for (int j = 0; j < samples; ++j) {
        const double u = 2.0 * pi * (i + 0.5) / samples;
        const double v = 2.0 * pi * (j + 0.5) / samples;
        const double slope = amplitude * wave_number;
        sum +=
            std::hypot(1.0, slope * std::cos(u) * std::sin(v), slope * std::sin(u) * std::cos(v));
      }
    }
    return sum / (samples * samples);
  }
};

/// A row of the sheet; shifted rows have half an edge at both ends.
std::vector<double> sheet_row(int columns, bool shifted) {
  std::vector<double> at;
  for (int k = 0; k <= columns; ++k) at.push_back((shifted ? k - 0.5 : k) / columns);
  if (!shifted) return at;
  at.front() = 0.0;
  at.push_back(1.0);
  return at;
}

}  // namespace

TriMesh wavy_sheet(const Request& request) {
  check_positive(request, {"width", "depth", "wavelength"});
  const double width = request.at("width");
  const double depth = request.at("depth");
  const SheetWaves waves{request.at("amplitude"), 2.0 * pi / request.at("wavelength")};
  const double stretch = waves.stretch();
  check_face_count(request, width * depth * stretch);
  const double flat_edge = request.edge_length / std::sqrt(stretch);
  const int columns = pieces(request, width, flat_edge, 1);
  const int rows = pieces(request, depth, unit_triangle_height * flat_edge, 1);
  Triangles mesh;
  Row below;
  for (int j = 0; j <= rows; ++j) {
    Row row{{}, sheet_row(columns, j % 2 == 1)};
    const double y = depth * (static_cast<double>(j) / rows - 0.5);
    for (const double at : row.at) {
      const double x = width * (at - 0.5);
      row.vertices.push_back(static_cast<int>(mesh.points.size()));
      mesh.points.emplace_back(x, y, waves.height(x, y));
    }
    if (j > 0) stitch(below, row, mesh);
    below = std::move(row);
  }
  return make_mesh(mesh.points, mesh.corners);
}

}  // namespace trivalent::remesh
