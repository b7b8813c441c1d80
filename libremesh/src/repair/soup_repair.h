#pragma once

#include <cstddef>

#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// Steps of repair(), each in place. They return how many elements they changed.

/// Sets coordinates of the faces' points to zero if they are below 1e-60 of the diagonal of these
/// points' bounding box: products of such distances leave the range of double-precision numbers,
/// and with them all geometry.
std::size_t drop_vanishing_coordinates(TriangleSoup& soup);

/// Joins points at the same place if both have an edge without a second face; faces that lose a
/// corner by it are dropped.
std::size_t join_coincident_points(TriangleSoup& soup);

/// Drops faces with the same corners as an earlier one, whatever their orientation.
std::size_t drop_repeated_faces(TriangleSoup& soup);

/// Turns faces, the fewer in every component, so that neighbors across edges of two faces agree.
std::size_t orient_faces(TriangleSoup& soup);

/// Edges of two faces that cannot agree, since the surface has only one side; changes nothing.
[[nodiscard]] std::size_t count_disagreeing_edges(const TriangleSoup& soup);

/// Gives every fan of faces at a point a point of its own; returns how many points were added.
std::size_t separate_fans(TriangleSoup& soup);

/// Drops points that no triangle uses.
std::size_t drop_isolated_points(TriangleSoup& soup);

}  // namespace trivalent::remesh
