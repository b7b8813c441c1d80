#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Pairs of faces, or of a face and an image of one, that meet elsewhere than in the vertex or edge
/// they share.
struct CrossingFaces {
  std::size_t count = 0;
  std::vector<std::array<int, 2>> first;  ///< as many as asked for, by index
};

/// By exact predicates. Faces without an area meet nothing.
///
/// @param max_places  Length of the list of pairs; up to max_crossing_pairs are counted, and the
///                     list is of those counted.
///
/// Cost: O(n log n + pairs of faces whose boxes overlap) for n faces; less where more cross than
/// are counted.
[[nodiscard]] CrossingFaces find_crossing_faces(std::span<const Eigen::Vector3d> points,
                                                std::span<const std::array<int, 3>> triangles,
                                                std::size_t max_places = 5);

[[nodiscard]] CrossingFaces find_crossing_faces(const TriMesh& mesh, std::size_t max_places = 5);

}  // namespace trivalent::remesh
