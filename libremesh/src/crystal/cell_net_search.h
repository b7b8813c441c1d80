#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "crystal/cell_division.h"
#include "crystal/cell_net.h"
#include "equalize/constrained_mesh.h"
#include "trivalent/remesh/crystallize.h"

namespace trivalent::remesh {

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
