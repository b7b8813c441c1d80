#pragma once

#include <array>
#include <map>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Points for images of vertices, so that faces that share a vertex share a point.
class UnfoldedVertices {
 public:
  /// @param points  Where new ones are added.
  UnfoldedVertices(const TriMesh& mesh, std::vector<Eigen::Vector3d>& points)
      : mesh_(mesh), points_(points) {}

  /// The number of the image of a vertex that is at a position, new or known.
  int number(VertexHandle v, const Eigen::Vector3d& position) {
    const Lattice::Image image = mesh_.lattice.image_of(position - mesh_.point(v));
    const auto [entry, is_new] = numbers_.try_emplace({v.idx(), image[0], image[1], image[2]},
                                                      static_cast<int>(points_.size()));
    if (is_new) points_.push_back(mesh_.point(v) + mesh_.lattice.translation(image));
    return entry->second;
  }

  /// The numbers of a face's corners.
  std::array<int, 3> numbers(FaceHandle f, const std::array<Eigen::Vector3d, 3>& corners) {
    std::array<int, 3> numbers{};
    std::size_t k = 0;
    for (const auto v : mesh_.fv_range(f)) {
      numbers[k] = number(v, corners[k]);
      ++k;
    }
    return numbers;
  }

 private:
  const TriMesh& mesh_;
  std::vector<Eigen::Vector3d>& points_;
  std::map<std::array<int, 4>, int> numbers_;
};

/// The corners of a face by a translation that brings the first into the cell.
[[nodiscard]] std::array<Eigen::Vector3d, 3> corners_in_cell(const TriMesh& mesh, FaceHandle f);

}  // namespace trivalent::remesh
