#pragma once

#include <functional>
#include <optional>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// How the displacements are kept in the tangent planes, [Pecanha2013, section 2.3].
enum class Restriction {
  hard,           ///< two unknowns per vertex, in its tangent plane: ⟨t, n⟩ = 0 exactly
  least_squares,  ///< three unknowns per vertex, ⟨t, n⟩ = 0 as a weighted row
};

/// State after one iteration of remesh(), or one round of crystallize().
struct RemeshProgress {
  int iteration = 0;              ///< 1 .. iterations
  int iterations = 0;             ///< wanted in all
  double mean_edge_length = 0.0;  ///< in the mesh's unit
  double relative_spread = 0.0;   ///< standard deviation / mean of the edge lengths
  double regular_fraction = 0.0;  ///< interior vertices of valence 6 / interior vertices
  int vertices = 0;
  double strain = 0.0;  ///< mean of (|e|/L - 1)² over the edges; crystallize() only
};

/// Parameters of [Pecanha2013, Algorithm 1], with its symbols.
struct RemeshOptions {
  double target_edge_length = 0.0;  ///< m, in the mesh's unit, > 0; must be set by the caller
  int iterations = 20;              ///< n, 1 to 1000
  int rings = 2;                    ///< k, 1 to 8: rings of neighbors in the relaxation operator
  double tolerance = 0.2;           ///< σ/m_i, in (0, 1): edges within m_i ± σ are left alone
  Restriction restriction = Restriction::hard;
  /// Edges whose faces' normals differ by more than this [rad] are creases; none: no creases.
  std::optional<double> feature_angle = std::nullopt;
  /// Called after every iteration; the mesh returned does not depend on it.
  std::function<void(const RemeshProgress&)> on_progress = {};
};

/// The remeshed surface and how it came out.
struct RemeshResult {
  TriMesh mesh;
  int iterations = 0;
  double relative_spread = 0.0;   ///< standard deviation / mean of the edge lengths
  double regular_fraction = 0.0;  ///< interior vertices of valence 6 / interior vertices
  bool stopped = false;           ///< ended before its time because that was asked for
  bool coarse_start = false;      ///< crystallize(): the net was divided from one twice as coarse
};

/// Remeshes a surface until all edges come close to one length, [Pecanha2013, Algorithm 1].
///
/// Edges that end at a crease and are far longer than the target are halved first, on the surface.
/// Every iteration splits long and collapses short edges by priority (Algorithms 2-3), corrects
/// valences by flips (Algorithm 4), relaxes all vertices within their tangent planes (Eq. 1-4), and
/// projects them onto the input surface. Genus, orientation and boundaries of the input are kept;
/// its vertices are not. Open boundaries and creases slide along themselves; their corners stay.
///
/// @param mesh  Oriented 2-manifold, open or closed; becomes the surface that vertices lie on.
/// @throws InvalidMesh    if the mesh has no faces, a vertex without a face, or a part without an
/// area.
/// @throws InvalidOption  if an option is out of its range, m is larger than the shape can hold or
/// more than twice the width of a needle, or so small that more than 2e7 faces would be needed.
///
/// A component can hold m if its area has room for the 20 faces of an icosahedron (for 2 if it is
/// open).
///
/// Cost: O(iterations · (n log n + k² n)) for the larger of input and output size n.
[[nodiscard]] RemeshResult remesh(const TriMesh& mesh, const RemeshOptions& options);

}  // namespace trivalent::remesh
