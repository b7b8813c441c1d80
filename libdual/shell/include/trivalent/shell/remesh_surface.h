#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/shell/json.h"
#include "trivalent/shell/surface_source.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// The steps of remesh_surface() after the repair, in their order.
enum class RemeshStep { remesh, measure };

struct RemeshSurfaceOptions {
  double target_edge_length = 0.0;    ///< m, in the surface's unit, > 0; must be set by the caller
  remesh::RemeshMethod method = {};   ///< its target_edge_length is set by remesh_surface()
  remesh::RepairOptions repair = {};  ///< its edge_length_on is set by remesh_surface()
  CellOptions cell = {};              ///< of which the surface shows one
  std::function<void(RemeshStep)> on_step = {};  ///< before each step; may change the method
};

/// A remeshed surface and how it came out; lengths in the unit of the input.
struct RemeshedSurface {
  remesh::RemeshResult net = {};
  std::vector<std::string> notes = {};  ///< what was changed in the input
  double wrap_offset = 0.0;             ///< distance from the input to its wrap; 0 without one
  double target_edge_length = 0.0;
  remesh::MeshQuality quality = {};
  remesh::TwoSidedDistance distance = {};  ///< between the net and the repaired input

  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Repairs a surface, joins it in its cell if there is one, remeshes it, and measures the result.
///
/// @throws remesh::InvalidMesh, remesh::InvalidOption as repair(), in_cell() and remesh_by().
[[nodiscard]] RemeshedSurface remesh_surface(const remesh::TriangleSoup& soup,
                                             const RemeshSurfaceOptions& options);

}  // namespace trivalent::shell
