#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Vertices of valence 5 and 7 inside a net, paired where they are neighbors.
struct Defects {
  int pairs = 0;   ///< dislocations: a vertex of valence 5 next to one of valence 7
  int lone_5 = 0;  ///< disclinations that positive curvature asks for
  int lone_7 = 0;  ///< disclinations that negative curvature asks for
};

/// Pairs neighbors of valence 5 and 7, each with at most one other, as many as possible. What is
/// left over are disclinations: of a scar of three and two, one.
///
/// Cost: O(n + d²) at most for d vertices of valence 5 or 7; about O(n) where they are few.
[[nodiscard]] Defects find_defects(const TriMesh& mesh);

}  // namespace trivalent::remesh
