#include "sources/shape_parts.h"

#include <cmath>

#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

void check_positive(const Request& request, std::initializer_list<std::string_view> names) {
  for (const auto name : names) {
    if (request.at(name) > 0.0) continue;
    throw InvalidOption(concat("make_shape: ", request.shape, ": ", name, " must be > 0, but is ",
                               request.at(name)));
  }
}

void check_face_count(const Request& request, double area) {
  const double faces = area / (unit_triangle_area * request.edge_length * request.edge_length);
  if (faces <= max_faces) return;
  throw InvalidOption(concat("make_shape: ", request.shape, " with edges of ", request.edge_length,
                             " would have about ", faces, " faces, more than ", max_faces,
                             "; take longer edges"));
}

int pieces(const Request& request, double length, double wanted, int min_pieces) {
  const double count = std::round(length / wanted);
  if (count >= min_pieces) return static_cast<int>(count);
  throw InvalidOption(concat("make_shape: edges of ", request.edge_length,
                             " are too long for this ", request.shape, "; take shorter ones"));
}

void stitch(const Row& lower, const Row& upper, Triangles& mesh) {
  std::size_t i = 0;
  std::size_t j = 0;
  const std::size_t last_lower = lower.vertices.size() - 1;
  const std::size_t last_upper = upper.vertices.size() - 1;
  while (i < last_lower || j < last_upper) {
    const bool along_lower =
        j == last_upper || (i < last_lower && std::abs(lower.at[i + 1] - upper.at[j]) <=
                                                  std::abs(upper.at[j + 1] - lower.at[i]));
    if (along_lower) {
      mesh.corners.push_back({lower.vertices[i], lower.vertices[i + 1], upper.vertices[j]});
      ++i;
    } else {
      mesh.corners.push_back({lower.vertices[i], upper.vertices[j + 1], upper.vertices[j]});
      ++j;
    }
  }
}

}  // namespace trivalent::remesh
