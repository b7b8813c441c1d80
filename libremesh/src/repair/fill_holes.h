#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Closes every boundary loop by triangles of small area between its vertices; where these would
/// use an edge that the mesh has elsewhere, by a fan around a new vertex at the loop's centroid.
///
/// @return Number of loops closed.
int fill_holes(TriMesh& mesh);

}  // namespace trivalent::remesh
