#include "trivalent/shell/remesh_surface.h"

#include <nlohmann/json.hpp>

#include "trivalent/shell/build.h"
#include "trivalent/shell/reports.h"

namespace trivalent::shell {
namespace {

void begin(const RemeshSurfaceOptions& options, RemeshStep step) {
  if (options.on_step) options.on_step(step);
}

}  // namespace

RemeshedSurface remesh_surface(const remesh::TriangleSoup& soup,
                               const RemeshSurfaceOptions& options) {
  remesh::RepairOptions repair = options.repair;
  repair.edge_length_on = [&](const remesh::TriMesh&) { return options.target_edge_length; };
  remesh::RepairResult repaired = remesh::repair(soup, repair);
  Surface input = in_cell({.mesh = std::move(repaired.mesh),
                           .notes = std::move(repaired.notes),
                           .wrap_offset = repaired.offset},
                          options.cell);
  begin(options, RemeshStep::remesh);
  RemeshedSurface result = {
      .net = remesh::remesh_by(input.mesh, options.method, options.target_edge_length),
      .notes = std::move(input.notes),
      .wrap_offset = input.wrap_offset,
      .target_edge_length = options.target_edge_length};
  begin(options, RemeshStep::measure);
  result.quality = remesh::measure_quality(result.net.mesh);
  result.distance = remesh::measure_distance(result.net.mesh, input.mesh);
  return result;
}

Json RemeshedSurface::json() const {
  return {{"notes", notes},
          {"wrap_offset", wrap_offset},
          {"iterations", net.iterations},
          {"net", net_json(net)},
          {"stopped", net.stopped},
          {"target_edge_length", target_edge_length},
          {"quality", quality_json(quality)},
          {"distance", distance_json(distance)}};
}

std::vector<dual::TableRow> RemeshedSurface::rows() const {
  std::vector<dual::TableRow> rows = quality_rows(quality);
  append(rows, net_rows(net));
  append(rows, distance_rows(distance));
  return rows;
}

}  // namespace trivalent::shell
