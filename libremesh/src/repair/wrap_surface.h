#pragma once

#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// Lengths of a wrap, in the mesh's unit.
struct WrapLengths {
  double alpha = 0.0;
  double offset = 0.0;
};

/// Closed surface around triangles, or around points if there are no triangles. See repair().
[[nodiscard]] TriangleSoup wrap_surface(const TriangleSoup& soup, const WrapLengths& lengths);

}  // namespace trivalent::remesh
