#pragma once

#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// Welds the corners of triangles that come with their own coordinates, as in STL files.
///
/// Equal corners become one vertex. Where edges then lack a second face, corners that differ by
/// rounding are welded too: by at most 4 units in the last place of a 32-bit number, or 1e-6 of the
/// shortest edge there, and never by more than a tenth of that edge. All is noted.
void weld_points(PolygonSoup& soup);

}  // namespace trivalent::remesh
