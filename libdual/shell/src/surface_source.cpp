#include "trivalent/shell/surface_source.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "trivalent/remesh/error.h"
#include "trivalent/shell/ideal_source.h"
#include "trivalent/shell/plan.h"

namespace trivalent::shell {
namespace {

remesh::ShapeArgument parse_argument(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string_view number = text.substr(std::min(equals + 1, text.size()));
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size()) {
    throw remesh::InvalidOption("a shape's parameter is name=number, not '" + std::string(text) +
                                "'");
  }
  return {.name = std::string(text.substr(0, equals)), .value = value};
}

double value_of(const remesh::ShapeParameter& parameter, const ShapeCall& call) {
  for (const remesh::ShapeArgument& argument : call.arguments) {
    if (argument.name == parameter.name) return argument.value;
  }
  return parameter.default_value;
}

/// A tenth of the smallest parameter of a shape: fine enough for all of them.
double coarse_edge_length(const ShapeCall& call) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const remesh::ShapeDescription& shape : remesh::built_in_shapes()) {
    if (shape.name != call.name) continue;
    for (const remesh::ShapeParameter& parameter : shape.parameters) {
      const double value = value_of(parameter, call);
      if (value != 0.0) smallest = std::min(smallest, std::abs(value));
    }
  }
  return smallest / 10.0;
}

remesh::TriMesh make_fine_shape(const ShapeCall& call, const dual::ShellOptions& options) {
  constexpr double faces_per_atom = 4.0;
  constexpr double min_faces = 4000.0;
  const remesh::TriMesh coarse =
      remesh::make_shape(call.name, call.arguments, coarse_edge_length(call));
  const Plan coarse_plan = plan(coarse, options);
  coarse_plan.require_feasible();  // before so many triangles are made
  const double n_faces = std::max(min_faces, faces_per_atom * coarse_plan.shell.atoms);
  const double edge_length =
      std::sqrt(1.0 / remesh::unit_triangle_area * remesh::surface_area(coarse) / n_faces);
  return remesh::make_shape(call.name, call.arguments, edge_length);
}

}  // namespace

ShapeCall parse_shape(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  ShapeCall call = {.name = std::string(text.substr(0, colon)), .arguments = {}};
  std::string_view rest = text.substr(std::min(colon + 1, text.size()));
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    call.arguments.push_back(parse_argument(rest.substr(0, comma)));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return call;
}

bool is_built_in(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':'));
  const auto& shapes = remesh::built_in_shapes();
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const remesh::ShapeDescription& shape) { return shape.name == name; });
}

remesh::TriangleSoup read_soup(const std::string& path) {
  return remesh::triangulate(remesh::read_polygon_soup(path == "-" ? "/dev/stdin" : path));
}

Surface repair_surface(const remesh::TriangleSoup& soup, const dual::ShellOptions& shell,
                       remesh::RepairOptions repair) {
  repair.edge_length_on = [&shell](const remesh::TriMesh& mesh) {
    return dual::estimate_shell(mesh, shell).edge_length;
  };
  remesh::RepairResult result = remesh::repair(soup, repair);
  return {.mesh = std::move(result.mesh),
          .notes = std::move(result.notes),
          .wrap_offset = result.offset};
}

Surface read_surface(const std::string& source, const dual::ShellOptions& shell,
                     remesh::RepairOptions repair) {
  if (is_ideal_structure(source)) {
    throw remesh::InvalidOption(source +
                                " is no surface but atoms already: relax, energy, view, "
                                "lammps and the others take it in place of a file");
  }
  if (is_built_in(source)) return {.mesh = make_fine_shape(parse_shape(source), shell)};
  return repair_surface(read_soup(source), shell, std::move(repair));
}

}  // namespace trivalent::shell
