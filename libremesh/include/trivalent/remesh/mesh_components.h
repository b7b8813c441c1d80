#pragma once

#include <optional>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A connected part of a surface. Lengths in the mesh's own unit.
struct MeshComponent {
  int vertices = 0;
  int edges = 0;
  int faces = 0;
  int boundary_edges = 0;
  double area = 0.0;
  double volume = 0.0;  ///< enclosed, < 0 if it is inside out; 0 if it is open
  BoundingBox box;
  std::optional<int> inside_of;  ///< the smallest closed component around it, as in an onion
  [[nodiscard]] bool is_closed() const { return boundary_edges == 0; }
  [[nodiscard]] int euler_characteristic() const { return vertices - edges + faces; }
};

/// Maximum edge length for a surface of this area, in the mesh's unit: a closed surface needs the
/// 20 faces of an icosahedron, an open one 2 faces.
[[nodiscard]] double longest_edge_for(double area, bool is_closed);

/// Maximum edge length for a part of this area and length, in the mesh's unit. The leanest closed
/// net of equal edges is a row of tetrahedra face to face, of √3/4 · 2√10 m² = 2.74 m² of area per
/// length m; of open ones, the narrowest is half as wide as its edges are long.
[[nodiscard]] double longest_edge_along(double area, double length, bool is_closed);

/// Maximum edge length of a net in a lattice, in the mesh's unit: with fewer edges across, vertices
/// would share more than one edge.
[[nodiscard]] double longest_edge_in(const Lattice& lattice);

/// All connected parts of a surface, in the order of their first faces.
struct MeshComponents {
  std::vector<MeshComponent> parts;
  std::vector<int> of_face;  ///< index into parts, one per face
};

/// Finds the connected parts of a surface. Components that cross each other are not nested.
///
/// Cost: O(n) for n faces, plus for every component the faces of those whose boxes enclose it.
[[nodiscard]] MeshComponents find_components(const TriMesh& mesh);

}  // namespace trivalent::remesh
