#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "crystal/cell_net.h"
#include "equalize/constrained_mesh.h"
#include "trivalent/remesh/crystallize.h"

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

struct CellNetOptions {
  CellDivision division;
  std::uint64_t seed = 0;
  int runs = 1;
  int max_nets = 1;                        ///< to be found
  std::function<bool()> should_stop = {};  ///< asked between moves
};

/// Searches for the net of a crystal's cell among those of its coarser net: of the twenty vertices
/// of Schwarz' P surface, say, which are too few for patches. Runs of annealing flip edges
/// anywhere; the energy is that of the net divided into two at each edge, as carbon of that size
/// [Metropolis1953]. A net with octagons where the surface bends most is found by this, and hardly
/// ever by moves of single 5-7 pairs.
///
/// @param start    On the surface, of more vertices than division.base_vertices; edges as long as
///   Membrane::fine_length wants them at the end are shorter than its own by √triangles_each().
/// @param surface  Closed, in the cell of `start`.
/// @return  Different nets of the least energies, the best first, divided, on the surface.
[[nodiscard]] std::vector<CellNet> search_cell_nets(const TriMesh& start, const TriMesh& surface,
                                                    const CellNetOptions& options);

/// A net as that of a surface without curves.
///
/// @param net  is_simplicial()
[[nodiscard]] ConstrainedMesh::State state_on(const SurfaceProjector& surface, const CellNet& net);

}  // namespace trivalent::remesh
