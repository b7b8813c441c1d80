#pragma once

#include <optional>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// How a net comes from a coarser one: by √3, or not, and into parts of its edges.
struct CellDivision {
  int base_vertices;
  int parts;
  bool by_sqrt3;

  /// Triangles of the net for each of the coarser one.
  [[nodiscard]] int triangles_each() const { return parts * parts * (by_sqrt3 ? 3 : 1); }
};

/// The division that comes nearest to a number of vertices, from the fewest vertices among equals;
/// none if all are too many or too few, or give a number that is off by more than 0.3 %.
///
/// @param euler  Of the surface in the cell, < 0.
[[nodiscard]] std::optional<CellDivision> plan_cell_division(int wanted_vertices, int euler);

/// The same for a surface; none unless it is periodic along three directions and its Euler
/// characteristic is negative.
[[nodiscard]] std::optional<CellDivision> plan_cell_division(const TriMesh& surface,
                                                             int wanted_vertices);

}  // namespace trivalent::remesh
