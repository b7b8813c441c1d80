#pragma once

#include <optional>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Chiral indices of a carbon nanotube: its circumference is n a1 + m a2, where a2 is a1 turned by
/// 60° counter-clockwise, seen from outside [Saito1998].
struct ChiralIndices {
  int n = 0;
  int m = 0;
  friend bool operator==(const ChiralIndices&, const ChiralIndices&) = default;
};

/// |n a1 + m a2|, in lengths of a1: the edges of a net of the tube.
[[nodiscard]] double circumference_of(ChiralIndices tube);

/// Says of a boundary vertex that a tube of these indices ends there. One vertex of a boundary is
/// enough; the surface keeps it through changes of its other vertices.
void set_tube_end(TriMesh& surface, VertexHandle v, ChiralIndices tube);

/// What was said; none if nothing was.
[[nodiscard]] std::optional<ChiralIndices> tube_end(const TriMesh& surface, VertexHandle v);

/// What was said of all boundaries.
[[nodiscard]] std::vector<ChiralIndices> wanted_tube_ends(const TriMesh& surface);

/// Length of the edges with which the boundaries become the ends of the tubes that were said, on
/// average; none if nothing was said.
[[nodiscard]] std::optional<double> edge_length_of_tubes(const TriMesh& surface);

/// The tube that each boundary of a net is the end of, n >= 1 and m >= 0: the sum of the boundary's
/// edges in the net's lattice. None where the net turns along its boundary, unlike at the end of a
/// tube.
[[nodiscard]] std::vector<std::optional<ChiralIndices>> find_tube_ends(const TriMesh& net);

}  // namespace trivalent::remesh
