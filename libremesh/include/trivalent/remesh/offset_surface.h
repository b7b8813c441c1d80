#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Triangulates the surface at a distance from another one: all points that are so far from it, on
/// the side to which its normals point if the distance is > 0, on the other if it is < 0.
///
/// Narrow parts vanish and gaps close once the offset is wider than they are, so that the result
/// may have other components and handles. A surface with a boundary keeps its triangles,
/// which are moved to that distance together with the boundary.
///
/// @param surface      Smooth, free or periodic.
/// @param edge_length  Mean edge length of the triangles, > 0, well below the distance; of no
///   meaning for a surface with a boundary.
/// @throws InvalidMesh if nothing is left at that distance, or the offset touches itself.
///
/// Cost: O(n) nearest points for n faces of the result.
[[nodiscard]] TriMesh offset_surface(const TriMesh& surface, double distance, double edge_length);

/// Triangulates a periodic surface anew in a cell of another lattice, with edges of the same mean
/// length.
///
/// @param surface  Smooth and without boundary, periodic along three directions.
/// @param lattice  Its translations map the surface onto itself, sides included.
/// @throws InvalidMesh if the surface has a boundary, or touches itself.
///
/// Cost: O(n) nearest points for n faces of the result.
[[nodiscard]] TriMesh surface_in_lattice(const TriMesh& surface, const Lattice& lattice);

}  // namespace trivalent::remesh
