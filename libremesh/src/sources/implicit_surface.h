#pragma once

#include <functional>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A closed surface given as the zero set of a function that is negative inside.
struct ImplicitSurface {
  /// Must not change faster than 1 per unit of length: then |value| is a lower bound of the
  /// distance to the surface, and space that is too far away is skipped.
  std::function<double(const Eigen::Vector3d&)> value;
  BoundingBox box;  ///< holds the surface with room on all sides
};

/// Triangulates an implicit surface, with edges of about edge_length.
///
/// Marches over the tetrahedra of a body-centered cubic lattice, whose points snap to the surface
/// where they come close, so that no slivers arise [Labelle2007]; then evens out the vertices.
/// The lattice must resolve the surface: edge_length well below every feature and radius of it.
///
/// @throws InvalidMesh if the lattice is too coarse for the surface.
///
/// Cost: O(n) for n faces.
[[nodiscard]] TriMesh polygonize(const ImplicitSurface& surface, double edge_length);

}  // namespace trivalent::remesh
