#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Statistics of a list of numbers.
struct Spread {
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the population (divided by n)
  double min = 0.0;
  double max = 0.0;
  /// Coefficient of variation: standard deviation / mean; 0 for an empty list.
  [[nodiscard]] double relative() const { return mean == 0.0 ? 0.0 : standard_deviation / mean; }
};

/// Maximum number of crossing pairs of faces that are counted; n faces may have n² of them.
constexpr int max_crossing_pairs = 1'000'000;

/// How regular a mesh is. Lengths in the mesh's own unit, angles in radian.
struct MeshQuality {
  int vertices = 0;  ///< used by at least one face
  int edges = 0;
  int faces = 0;
  int euler_characteristic = 0;  ///< vertices - edges + faces
  int components = 0;
  int boundary_loops = 0;
  Spread edge_length;
  std::map<int, int> valences;    ///< interior vertices by valence
  double regular_fraction = 0.0;  ///< interior vertices of valence 6 / interior vertices; 0 if none
  double smallest_angle = 0.0;    ///< [rad]
  double largest_angle = 0.0;     ///< [rad]
  int self_intersections = 0;     ///< pairs of faces that meet outside the points and edges they
                                  ///< share, up to max_crossing_pairs
};

/// Measures a mesh. Cost: O(n log n) for n faces, dominated by the intersection test.
[[nodiscard]] MeshQuality measure_quality(const TriMesh& mesh);

/// Distance from one surface to another, over area-uniform samples, in the meshes' own unit. `max`
/// includes every vertex, and is a lower bound of the Hausdorff distance.
struct SurfaceDistance {
  double max = 0.0;
  double mean = 0.0;
  double root_mean_square = 0.0;
};

/// Distances in both directions, since neither bounds the other.
struct TwoSidedDistance {
  SurfaceDistance to_original;                    ///< from samples of the mesh to the original
  SurfaceDistance from_original;                  ///< from samples of the original to the mesh
  double diagonal = 0.0;                          ///< bounding-box diagonal of the original
  [[nodiscard]] double max() const;               ///< the larger of both directions
  [[nodiscard]] double root_mean_square() const;  ///< the larger of both directions
};

/// @param samples  Points per direction, >= 1; the same for every call with the same meshes.
/// @throws InvalidMesh   if one of the meshes has no face with an area.
/// @throws InvalidOption if samples < 1.
[[nodiscard]] TwoSidedDistance measure_distance(const TriMesh& mesh, const TriMesh& original,
                                                int samples = 200000);

/// Distance of every point to the surface, in their common unit.
///
/// @throws InvalidMesh if no face of the surface has an area.
[[nodiscard]] std::vector<double> distances_to_surface(std::span<const Eigen::Vector3d> points,
                                                       const TriMesh& surface);

}  // namespace trivalent::remesh
