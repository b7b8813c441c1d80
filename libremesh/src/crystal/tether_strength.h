#pragma once

#include "trivalent/remesh/crystallize.h"

namespace trivalent::remesh {

/// How strongly net and surface hold each other [eV/Å²], and how far apart they may be freely [Å].
struct TetherStrength {
  double tether;
  double cover;
  double slack;
};

/// @throws InvalidOption  if `follow` is no enumerator.
[[nodiscard]] TetherStrength tether_of(const CrystalOptions& options);

/// Whether the net is held to the surface up to the end, equally on every shape.
[[nodiscard]] bool is_held(const CrystalOptions& options);

/// √area of a component, on average: how large a shape is.
[[nodiscard]] double size_of_component(const TriMesh& surface);

/// How much stiffer than on shapes of middling size the tether is, from the curvature.
///
/// @param surface  In Å.
[[nodiscard]] double tether_factor(const TriMesh& surface, double area);

}  // namespace trivalent::remesh
