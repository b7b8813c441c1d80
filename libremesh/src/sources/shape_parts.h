#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"

/// What built-in shapes are made from.
namespace trivalent::remesh {

/// Height of the equilateral triangle of edge 1.
inline constexpr double unit_triangle_height = 0.5 * std::numbers::sqrt3;

/// Values of one shape's parameters, and the edge length asked for.
struct Request {
  std::string_view shape;
  std::map<std::string, double, std::less<>> values;
  std::vector<std::vector<double>> lists = {};  ///< of the parameter that is one, in their order
  double edge_length = 0.0;

  [[nodiscard]] double at(std::string_view name) const { return values.find(name)->second; }
};

/// @throws InvalidOption if one of the parameters is not > 0.
void check_positive(const Request& request, std::initializer_list<std::string_view> names);

/// @throws InvalidOption if a shape of this area would have too many faces.
void check_face_count(const Request& request, double area);

/// Number of pieces of about length `wanted` in `length`.
/// @throws InvalidOption if there would be fewer than `min_pieces`.
[[nodiscard]] int pieces(const Request& request, double length, double wanted, int min_pieces);

struct Triangles {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> corners;
};

/// Vertices along a line and where they lie on it, in [0, 1] or a little beyond; a ring repeats its
/// first vertex at the end, a pole has one vertex.
struct Row {
  std::vector<int> vertices;
  std::vector<double> at;
};

/// Fills the strip between two rows, always with the diagonal that leans less.
void stitch(const Row& lower, const Row& upper, Triangles& mesh);

}  // namespace trivalent::remesh
