#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// The same surface, with edges halved that end at a crease and are far longer than the target
/// length, the longest first, so that faces keep their shape. At the corners of faces far larger
/// than those of a net the normals are means over half of a solid, and its first edges would cut
/// creases deeply. Stops where the surface would have far more faces than a net.
[[nodiscard]] TriMesh with_edges_divided(const TriMesh& surface, double target);

}  // namespace trivalent::remesh
