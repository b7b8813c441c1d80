#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// Reasons why triangles are no sound surface.
enum class Problem {
  isolated_point,    ///< used by no face
  coincident_point,  ///< at the position of an earlier point
  repeated_face,     ///< has the corners of an earlier face
  flat_face,         ///< has no area
  crowded_edge,      ///< shared by more than two faces
  misoriented_edge,  ///< both its faces run the same way along it
  pinched_vertex,    ///< belongs to more than one fan of faces
  far_point,         ///< over 100 times the median distance from the middle
  crossing_faces,    ///< two faces that meet outside the points and edges they share
};

/// Name in the singular, such as "isolated point".
[[nodiscard]] std::string_view name_of(Problem problem);

/// Where a problem occurs.
struct ProblemPlace {
  std::vector<int> elements;  ///< a point, a face, two faces, or the two points of an edge
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its first point, in the mesh's unit
};

/// One kind of problem.
struct Finding {
  Problem problem = Problem::isolated_point;
  std::size_t count = 0;
  std::vector<ProblemPlace> first;  ///< the first few, by index
};

/// Findings about triangles that may or may not form a surface.
struct MeshDiagnosis {
  int points = 0;
  int faces = 0;
  int components = 0;                          ///< sets of faces joined across edges
  int boundary_edges = 0;                      ///< used by one face
  int boundary_loops = 0;                      ///< sets of boundary edges joined at points
  std::vector<ProblemPlace> first_boundaries;  ///< the first edge of the first few loops
  std::vector<Finding> findings;               ///< in the order of Problem; none with a count of 0

  /// Whether make_mesh() accepts the triangles.
  [[nodiscard]] bool is_oriented_manifold() const;
};

/// Finds all problems but crossing faces. Cost: O(n log n) for n faces.
[[nodiscard]] MeshDiagnosis diagnose(const TriangleSoup& soup);

/// Counts pairs of faces that meet outside the points and edges they share, by exact predicates, up
/// to max_crossing_pairs. Points at the same position count as one; repeated faces and faces
/// without an area cross nothing.
///
/// Cost: O(n log n + pairs of faces whose boxes overlap) for n faces.
[[nodiscard]] Finding find_crossing_faces(const TriangleSoup& soup);

}  // namespace trivalent::remesh
