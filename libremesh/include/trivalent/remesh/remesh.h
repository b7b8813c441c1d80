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

/// State after an iteration of remesh() or a round of crystallize().
struct RemeshProgress {
  int iteration = 0;              ///< 1 .. iterations
  int iterations = 0;             ///< planned in all
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
  /// Edges whose faces' normals differ by more than this [rad] are creases. If empty, there are
  /// none.
  std::optional<double> feature_angle = std::nullopt;
  /// Called after every iteration; the mesh returned does not depend on it.
  std::function<void(const RemeshProgress&)> on_progress = {};
  /// Called several times per iteration; once it returns true, the mesh so far is returned.
  std::function<bool()> should_stop = {};
};

/// The remeshed surface and its quality.
struct RemeshResult {
  TriMesh mesh;
  int iterations = 0;
  double relative_spread = 0.0;   ///< standard deviation / mean of the edge lengths
  double regular_fraction = 0.0;  ///< interior vertices of valence 6 / interior vertices
  bool stopped = false;           ///< ended early on request
  bool coarse_start = false;      ///< crystallize(): the net was divided from one twice as coarse
  int copies = 1;  ///< crystallize(): of the net of a primitive cell, of which the mesh consists
};

/// Remeshes a surface until all edges come close to one length, [Pecanha2013, Algorithm 1].
///
/// First halves edges that end at a crease and are far longer than the target. Then every iteration
/// splits long and collapses short edges by priority (Algorithms 2-3), corrects valences by flips
/// (Algorithm 4), relaxes all vertices within their tangent planes (Eq. 1-4), and projects them
/// onto the input surface. Keeps genus, orientation and boundaries of the input, but not its
/// vertices. Vertices on open boundaries and creases slide along them; corners stay.
///
/// @param mesh  Oriented 2-manifold, open or closed; becomes the surface that vertices lie on.
/// @throws InvalidMesh    if the mesh has no faces, a vertex without a face, or a part of area 0.
/// @throws InvalidOption  if an option is out of its range, or m is too large for a part (see
///   longest_edge_for() and longest_edge_along()) or needs more than
///   max_faces.
/// @throws Stopped        if options.should_stop returns true before the first iteration is done.
///
/// Cost: O(iterations · (n log n + k² n)) for the larger of input and output size n.
[[nodiscard]] RemeshResult remesh(const TriMesh& mesh, const RemeshOptions& options);

}  // namespace trivalent::remesh
