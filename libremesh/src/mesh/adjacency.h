#pragma once

#include <array>
#include <span>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A list of indices for every element, one list after the other.
struct IndexLists {
  std::vector<int> begin;  ///< where each list begins in `items`, and the end of the last
  std::vector<int> items;

  [[nodiscard]] std::span<const int> operator[](std::size_t i) const {
    const auto from = static_cast<std::size_t>(begin[i]);
    return std::span(items).subspan(from, static_cast<std::size_t>(begin[i + 1]) - from);
  }
};

/// One-ring of every vertex, clockwise; empty for a deleted one.
[[nodiscard]] IndexLists one_rings(const TriMesh& mesh);

/// Triangles at every vertex, in ascending order.
[[nodiscard]] IndexLists triangles_at_vertices(std::span<const std::array<int, 3>> triangles,
                                               std::size_t n_vertices);

/// Faces in an order in which every component is contiguous.
struct FacesByComponent {
  std::vector<FaceHandle> faces;
  std::vector<std::size_t> ends;  ///< one per component

  [[nodiscard]] std::span<const FaceHandle> component(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(faces).subspan(begin, ends[i] - begin);
  }
};
/// Components are joined across edges, and come in the order of their first faces.
[[nodiscard]] FacesByComponent faces_by_component(const TriMesh& mesh);

/// Vertices along each boundary, with the surface to the right.
[[nodiscard]] std::vector<std::vector<VertexHandle>> boundary_loops(const TriMesh& mesh);

[[nodiscard]] bool has_boundary(const TriMesh& mesh);

}  // namespace trivalent::remesh
