#pragma once

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Which edges a round of stellar operations changes.
struct StellarLimits {
  double target = 0.0;    ///< m_i
  double shortest = 0.0;  ///< m_i - σ: shorter edges are collapsed
  double longest = 0.0;   ///< m_i + σ: longer edges are split
  double overlong = 0.0;  ///< no collapse may make an edge longer than this
  /// Edges between these limits are changed too if that mends valences: collapsed below m_i, split
  /// above.
  bool mends_valences = false;
};

/// Splits long and collapses short edges, those farthest from the target first
/// [Pecanha2013, Algorithms 2 and 3]. A changed edge locks the vertices around it for the rest of
/// the round. An edge is collapsed only if the link condition holds, no face turns over or
/// degenerates, no overlong edge arises, and no feature curve is torn off.
///
/// @return Number of edges changed.
int apply_stellar_operations(ConstrainedMesh& constrained, const StellarLimits& limits);

/// Halves every edge longer than a length, the longest first, without locks. For edges far longer
/// than the target: where many of them meet in one vertex, locks let through one split a round,
/// while every split on the other side of their faces adds another such edge.
void split_edges_longer_than(ConstrainedMesh& constrained, double length);

}  // namespace trivalent::remesh
