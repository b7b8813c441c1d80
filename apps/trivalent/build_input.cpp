#include "build_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "files.h"
#include "trivalent/remesh/mesh_io.h"

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
  const double n_faces =
      std::max(fewest_faces, faces_per_atom * dual::estimate_atom_count(coarse, options));
  const double edge_length =
      std::sqrt(4.0 / std::sqrt(3.0) * remesh::surface_area(coarse) / n_faces);
  return remesh::make_shape(call.name, call.arguments, edge_length);
}

}  // namespace

BuildInput read_build_input(const std::string& shape, const dual::ShellOptions& options) {
  if (is_built_in(shape.substr(0, shape.find(':')))) {
    return {.mesh = make_fine_shape(parse_shape(shape), options), .notes = {}};
  }
  remesh::MeshFile file = remesh::read_mesh(shape);
  return {.mesh = std::move(file.mesh), .notes = std::move(file.notes)};
}

}  // namespace trivalent::apps
