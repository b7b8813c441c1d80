#include "io/vtk_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// A kind of cell with one polygon: VTK's number, how many points it has (0: any number), and the
/// order in which the first of them run around it.
struct PolygonKind {
  int type;
  std::size_t points;
  std::array<std::uint8_t, 8> order;
  std::size_t corners;
};

/// From VTK's vtkCellType.h, and the order of points from "The VTK File Formats".
constexpr std::array polygon_kinds = {
    PolygonKind{5, 3, {0, 1, 2}, 3},                  // triangle
    PolygonKind{8, 4, {0, 1, 3, 2}, 4},               // pixel
    PolygonKind{9, 4, {0, 1, 2, 3}, 4},               // quad
    PolygonKind{22, 6, {0, 3, 1, 4, 2, 5}, 6},        // quadratic triangle
    PolygonKind{23, 8, {0, 4, 1, 5, 2, 6, 3, 7}, 8},  // quadratic quad
    PolygonKind{28, 9, {0, 4, 1, 5, 2, 6, 3, 7}, 8},  // biquadratic quad
    PolygonKind{34, 7, {0, 3, 1, 4, 2, 5}, 6},        // biquadratic triangle
};

/// Points, lines and their curved kinds.
constexpr std::array line_kinds = {0, 1, 2, 3, 4, 21, 35};

bool is_volume(int type) {
  // Tetrahedra to prisms, and the same with curved edges.
  return (type >= 10 && type <= 16) || (type >= 24 && type <= 33 && type != 28 && type != 30) ||
         type == 42;
}

}  // namespace

void VtkCells::add_points(std::span<const double> coordinates) {
  if (soup_.points.size() + coordinates.size() / 3 >
      static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    fail(source_, concat("declares more than ", std::numeric_limits<int>::max(), " points"));
  }
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    soup_.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    if (soup_.points.back().allFinite()) continue;
    fail(source_, concat("vertex ", soup_.points.size() - 1,
                         " (counted from 0) has a coordinate that is not a finite number"));
  }
}

void VtkCells::add_cells(const VtkCellArrays& arrays) {
  const std::size_t points = soup_.points.size() - arrays.first_point;
  std::vector<int> corners;
  double begin = 0.0;
  for (std::size_t i = 0; i < arrays.ends.size(); ++i) {
    const double end = arrays.ends[i];
    if (!(end >= begin && end <= static_cast<double>(arrays.connectivity.size())) ||
        end != std::floor(end)) {
      arrays.fail(concat("face ", i, " (counted from 0) ends at ", end, " of ",
                         arrays.connectivity.size(), " corners"));
    }
    corners.clear();
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const double v = arrays.connectivity[k];
      if (!(v >= 0.0 && v < static_cast<double>(points)) || v != std::floor(v)) {
        arrays.fail(
            concat("face ", i, " refers to vertex ", v, " of ", points, " (counted from 0)"));
      }
      corners.push_back(static_cast<int>(arrays.first_point) + static_cast<int>(v));
    }
    const double type = arrays.types.empty() ? static_cast<double>(arrays.type) : arrays.types[i];
    add_cell(type, corners, arrays);
    begin = end;
  }
}

void VtkCells::add_cell(double type, std::span<const int> corners, const VtkCellArrays& arrays) {
  const int kind = type >= 0.0 && type < 256.0 ? static_cast<int>(type) : 255;
  if (kind == static_cast<int>(VtkCell::polygon)) return add_polygon(corners);
  if (kind == static_cast<int>(VtkCell::strip)) return append_strip(soup_, corners);
  if (std::ranges::find(line_kinds, kind) != line_kinds.end()) {
    ++lines_;
    return;
  }
  if (is_volume(kind)) {
    ++volumes_;
    return;
  }
  const auto* known = std::ranges::find(polygon_kinds, kind, &PolygonKind::type);
  if (known == polygon_kinds.end()) {
    arrays.fail(concat("a cell is of VTK's type ", type, ", which is not known"));
    return;
  }
  if (corners.size() != known->points) {
    arrays.fail(concat("a cell of VTK's type ", kind, " has ", corners.size(), " points, not ",
                       known->points));
  }
  if (known->corners > 4) ++curved_;
  for (std::size_t k = 0; k < known->corners; ++k) {
    soup_.corners.push_back(corners[known->order[k]]);
  }
  soup_.ends.push_back(soup_.corners.size());
}

void VtkCells::add_polygon(std::span<const int> corners) {
  soup_.corners.insert(soup_.corners.end(), corners.begin(), corners.end());
  soup_.ends.push_back(soup_.corners.size());
}

PolygonSoup VtkCells::take() {
  if (volumes_ > 0) {
    fail(source_, concat("holds ", counted(volumes_, "cell"),
                         " of volumes, such as tetrahedra; extract its surface in ParaView, and "
                         "save that"));
  }
  if (lines_ > 0) soup_.notes.push_back(concat("left out ", counted(lines_, "line")));
  if (curved_ > 0) {
    soup_.notes.push_back(
        concat("took ", counted(curved_, "curved face"), " as flat between their points"));
  }
  return std::move(soup_);
}

}  // namespace trivalent::remesh
