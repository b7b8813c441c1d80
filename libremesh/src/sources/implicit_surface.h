#pragma once

#include <functional>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A surface given as the zero set of a function that is negative inside.
struct ImplicitSurface {
  /// Must not change faster than 1 per unit of length: then |value| is a lower bound of the
  /// distance to the surface, and space that is too far away is skipped. In a lattice that is asked
  /// near the surface only.
  std::function<double(const Eigen::Vector3d&)> value;
  BoundingBox box = {};  ///< holds a free, closed surface with room on all sides
  /// If it has a cell, that is triangulated instead of the box. Along vectors that are not
  /// periodic, the surface lies between -1/2 and 1/2 of them.
  Lattice lattice = {};
  /// Whether grid points move to the surface where they come close. That leaves no slivers, but
  /// sheets that are nearer to each other than the grid's points may touch.
  bool snaps = true;
};

/// Triangulates an implicit surface, with edges of about edge_length; in a lattice, one cell of it.
///
/// Marches over the tetrahedra of a body-centered cubic grid, whose points snap to the surface
/// where they come close, so that no slivers arise [Labelle2007]; then evens out the vertices. In a
/// lattice the grid is stretched to fit the cell. The grid must resolve the surface: edge_length
/// well below every feature and radius of it.
///
/// @throws InvalidMesh if there is no surface, it leaves the box, or the grid is too coarse for it.
///
/// Cost: O(n) for n faces.
[[nodiscard]] TriMesh polygonize(const ImplicitSurface& surface, double edge_length);

/// The same; without snapping where snapped sheets would touch.
[[nodiscard]] TriMesh polygonize_any(ImplicitSurface surface, double edge_length);

}  // namespace trivalent::remesh
