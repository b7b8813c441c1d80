#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "mesh/geometry.h"
#include "sources/built_in_shapes.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

Triangles icosahedron() {
  constexpr double g = std::numbers::phi;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Divides every edge of a triangle mesh into `frequency` parts and every face into frequency².
class Subdivision {
 public:
  Subdivision(const Triangles& coarse, int frequency) : coarse_(coarse), frequency_(frequency) {
    fine_.points = coarse.points;
    for (const auto& corners : coarse.corners) divide(corners);
  }
  [[nodiscard]] const Triangles& result() const { return fine_; }

 private:
  [[nodiscard]] Eigen::Vector3d corner(int v) const {
    return coarse_.points[static_cast<std::size_t>(v)];
  }

  int add_point(const Eigen::Vector3d& p) {
    fine_.points.push_back(p);
    return static_cast<int>(fine_.points.size()) - 1;
  }

  /// The vertex at k/frequency of the way from a to b.
  int on_edge(int a, int b, int k) {
    if (k == 0) return a;
    if (k == frequency_) return b;
    if (a > b) return on_edge(b, a, frequency_ - k);
    const auto [found, is_new] = first_on_edge_.try_emplace({a, b}, fine_.points.size());
    if (is_new) {
      for (int i = 1; i < frequency_; ++i)
        add_point(corner(a) + (corner(b) - corner(a)) * i / frequency_);
    }
    return static_cast<int>(found->second) + k - 1;
  }

  /// Vertices of the face in row `row` (0 at corner a, parallel to bc).
  std::vector<int> row_of(const std::array<int, 3>& face, int row) {
    const auto [a, b, c] = face;
    std::vector<int> vertices = {on_edge(a, b, row)};
    if (row == 0) return vertices;
    for (int k = 1; k < row; ++k) {
      if (row == frequency_)
        vertices.push_back(on_edge(b, c, k));
      else
        vertices.push_back(add_point(corner(a) + (corner(b) - corner(a)) * row / frequency_ +
                                     (corner(c) - corner(b)) * k / frequency_));
    }
    vertices.push_back(on_edge(a, c, row));
    return vertices;
  }

  void divide(const std::array<int, 3>& face) {
    std::vector<int> above = row_of(face, 0);
    for (int row = 1; row <= frequency_; ++row) {
      const std::vector<int> below = row_of(face, row);
      for (std::size_t k = 0; k < above.size(); ++k) {
        fine_.corners.push_back({above[k], below[k], below[k + 1]});
        if (k + 1 < above.size()) fine_.corners.push_back({above[k], below[k + 1], above[k + 1]});
      }
      above = below;
    }
  }

  const Triangles& coarse_;
  int frequency_;
  Triangles fine_;
  std::map<std::pair<int, int>, std::size_t> first_on_edge_;
};

/// Geodesic subdivision of the unit sphere, stretched along the axes.
TriMesh stretched_sphere(const Request& request, const Eigen::Vector3d& radii) {
  // Thomsen's formula, within 1.1 % of an ellipsoid's area.
  const double p = 1.6075;
  const Eigen::Array3d r = radii.array().pow(p);
  const double area = 4.0 * pi * std::pow((r[0] * r[1] + r[0] * r[2] + r[1] * r[2]) / 3.0, 1.0 / p);
  check_face_count(request, area);
  const double icosahedron_edge = std::sqrt(area / (20.0 * unit_triangle_area));
  const Triangles base = icosahedron();
  const Subdivision subdivision(base, pieces(request, icosahedron_edge, request.edge_length, 1));
  Triangles fine = subdivision.result();
  for (Eigen::Vector3d& point : fine.points) point = point.normalized().cwiseProduct(radii);
  return make_mesh(fine.points, fine.corners);
}

}  // namespace

TriMesh sphere(const Request& request) {
  check_positive(request, {"radius"});
  return stretched_sphere(request, Eigen::Vector3d::Constant(request.at("radius")));
}

TriMesh ellipsoid(const Request& request) {
  check_positive(request, {"a", "b", "c"});
  return stretched_sphere(request, {request.at("a"), request.at("b"), request.at("c")});
}

}  // namespace trivalent::remesh
