#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Number of pairs of faces that meet elsewhere than in the vertex or edge they share, by exact
/// predicates. Faces without an area meet nothing.
///
/// Cost: O(n log n + pairs of faces whose boxes overlap) for n faces.
[[nodiscard]] int count_self_intersections(const TriMesh& mesh);

}  // namespace trivalent::remesh
