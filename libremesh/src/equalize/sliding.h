#pragma once

#include <vector>

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Moves all vertices at once: each to the point of the original surface, or of its feature curve,
/// that is nearest to its target; corners stay. Vertices of faces that would turn over go only half
/// the way, or stay.
///
/// @param targets  One position per vertex, in the mesh's unit.
void slide_vertices(ConstrainedMesh& constrained, const std::vector<Eigen::Vector3d>& targets);

/// Lifts vertices off the surface, along its normals, until faces lie half inside and half outside
/// of it: with vertices on a curved surface all faces are chords on one side. Halves the distance
/// between both, and centroids come to lie on the surface but for a quarter of their depth.
/// Vertices on feature curves stay.
void straddle_surface(ConstrainedMesh& constrained);

}  // namespace trivalent::remesh
