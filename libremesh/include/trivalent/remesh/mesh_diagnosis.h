#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// What keeps triangles from being a sound surface.
enum class Problem {
  isolated_point,    ///< used by no face
  coincident_point,  ///< where an earlier point is
  repeated_face,     ///< with the corners of an earlier face
  flat_face,         ///< without an area
  crowded_edge,      ///< shared by more than two faces
  misoriented_edge,  ///< both its faces run the same way along it
  pinched_vertex,    ///< where more than one fan of faces meets
  far_point,         ///< 100 times as far from the middle as half of the points are
  crossing_faces,    ///< two that meet elsewhere than in what they share
};

/// "isolated point" and so on.
[[nodiscard]] std::string_view name_of(Problem problem);

/// Where a problem occurs.
struct Place {
  std::vector<int> elements;  ///< a point, a face, two faces, or the two points of an edge
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its first point, in the mesh's unit
};

/// One kind of problem.
struct Finding {
  Problem problem = Problem::isolated_point;
  std::size_t count = 0;
  std::vector<Place> first;  ///< the first few, by index
};

/// All about triangles that may or may not form a surface.
struct MeshDiagnosis {
  int points = 0;
  int faces = 0;
  int components = 0;                   ///< of faces joined across edges
  int boundary_edges = 0;               ///< used by one face
  int boundary_loops = 0;               ///< of boundary edges joined at points
  std::vector<Place> first_boundaries;  ///< the first edge of the first few loops
  std::vector<Finding> findings;        ///< in the order of Problem; none with a count of 0

  /// Whether make_mesh() accepts the triangles.
  [[nodiscard]] bool is_oriented_manifold() const;
};

/// Finds what is wrong, except for crossing faces. Cost: O(n log n) for n faces.
[[nodiscard]] MeshDiagnosis diagnose(const TriangleSoup& soup);

/// Pairs of faces that meet elsewhere than in the points and edges they share, by exact predicates.
/// Points at the same place count as one; faces repeated or without an area cross nothing. Counts
/// up to most_crossing_pairs.
///
/// Cost: O(n log n + pairs of faces whose boxes overlap) for n faces; less where more cross than
/// are counted.
[[nodiscard]] Finding find_crossing_faces(const TriangleSoup& soup);

}  // namespace trivalent::remesh
