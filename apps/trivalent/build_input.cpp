#include "build_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "files.h"
#include "surface_input.h"
#include "trivalent/remesh/error.h"

namespace trivalent::apps {
namespace {

/// A tenth of the smallest measure of a shape: fine enough for each of them.
double coarse_edge_length(const ShapeCall& call) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const remesh::ShapeDescription& shape : remesh::built_in_shapes()) {
    if (shape.name != call.name) continue;
    for (const remesh::ShapeParameter& parameter : shape.parameters) {
      double value = parameter.default_value;
      for (const auto& argument : call.arguments) {
        if (argument.name == parameter.name) value = argument.value;
      }
      if (value != 0.0) smallest = std::min(smallest, std::abs(value));
    }
  }
  return smallest / 10.0;
}

remesh::TriMesh make_fine_shape(const ShapeCall& call, const dual::ShellOptions& options) {
  constexpr double faces_per_atom = 4.0;
  constexpr double fewest_faces = 4000.0;
  const remesh::TriMesh coarse =
      remesh::make_shape(call.name, call.arguments, coarse_edge_length(call));
  const BuildPlan plan = plan_build(coarse, options);
  check_plan(plan);  // before so many triangles are made
  const double n_faces = std::max(fewest_faces, faces_per_atom * plan.shell.atoms);
  const double edge_length =
      std::sqrt(4.0 / std::sqrt(3.0) * remesh::surface_area(coarse) / n_faces);
  return remesh::make_shape(call.name, call.arguments, edge_length);
}

}  // namespace

BuildInput read_build_input(const Session& session, const dual::ShellOptions& options) {
  const auto& shape = session.get<std::string>("SHAPE");
  if (is_built_in(shape.substr(0, shape.find(':')))) {
    return {.mesh = make_fine_shape(parse_shape(shape), options), .notes = {}};
  }
  remesh::RepairResult read = read_surface(shape, session, [&options](const remesh::TriMesh& mesh) {
    return dual::estimate_shell(mesh, options).edge_length;
  });
  return {.mesh = std::move(read.mesh), .notes = std::move(read.notes), .wrap_offset = read.offset};
}

void check_plan(const BuildPlan& plan) {
  if (!plan.obstacles.empty()) throw remesh::InvalidMesh("build: " + plan.obstacles.front());
}

}  // namespace trivalent::apps
