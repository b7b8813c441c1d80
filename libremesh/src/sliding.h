#pragma once

#include <vector>

#include "constrained_mesh.h"

namespace trivalent::remesh {

/// Moves all vertices at once: each to the point of the original surface, or of its feature curve,
/// that is nearest to its target; corners stay. Vertices of faces that would turn over go only half
/// the way, or stay.
///
/// @param targets  One position per vertex, in the mesh's unit.
void slide_vertices(ConstrainedMesh& constrained, const std::vector<Eigen::Vector3d>& targets);

}  // namespace trivalent::remesh
