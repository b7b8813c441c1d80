#pragma once

#include <array>
#include <span>
#include <vector>

#include "lattice_vector.h"

namespace trivalent::dual {

/// A triangular face of a polyhedron, on a triangular lattice that is laid over it.
struct LatticeFace {
  std::array<int, 3> corners;       ///< numbers, counter-clockwise seen from outside
  std::array<LatticeVector, 3> at;  ///< where they lie, likewise counter-clockwise

  /// How much of the face's area each corner has at a point of it: barycentric coordinates.
  [[nodiscard]] std::array<double, 3> weights(LatticeVector point) const;
};

/// A closed polyhedron's triangulation by one lattice that goes on over all its edges.
struct LatticeTriangulation {
  struct Vertex {
    int face;          ///< one that holds it
    LatticeVector at;  ///< on that face's lattice
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// Triangulates a closed, oriented polyhedron whose corners are lattice points [Caspar1962]. A
/// vertex has the valence 6 but at corners, where six less the valence are the sixths of a turn
/// that the faces' angles there fall short of a whole one.
///
/// @param faces  A corner pair is an edge of two faces, and as long in both.
[[nodiscard]] LatticeTriangulation triangulate(std::span<const LatticeFace> faces);

}  // namespace trivalent::dual
