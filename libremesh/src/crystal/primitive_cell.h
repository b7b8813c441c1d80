#pragma once

#include <optional>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// The lattice of all translations that map a surface onto itself, sides included: that of its own
/// cell, or with more translations by halves and thirds of cell vectors.
///
/// @param surface    Periodic along three directions.
/// @param tolerance  How far apart the surface and its moved copy may be.
[[nodiscard]] Lattice primitive_lattice(const TriMesh& surface, double tolerance);

/// A surface in its primitive cell.
struct PrimitiveCell {
  TriMesh surface;
  int copies;  ///< primitive cells in the surface's own
};

/// The primitive cell of a crystal's surface: periodic along three directions, of negative Euler
/// characteristic. Flat surfaces repeat themselves at any translation.
///
/// @param m  Edge length that a net is to have, which says how exactly the surface has to repeat
///   itself and how large the primitive cell must be for a net.
/// @return   None if the surface's own cell is the smallest that will do.
[[nodiscard]] std::optional<PrimitiveCell> primitive_cell(const TriMesh& surface, double m);

}  // namespace trivalent::remesh
