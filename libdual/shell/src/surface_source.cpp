#include "trivalent/shell/surface_source.h"

#include <Eigen/LU>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "trivalent/formats/cell_angles.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/level_set.h"
#include "trivalent/remesh/periodic.h"
#include "trivalent/remesh/volume.h"
#include "trivalent/shell/ideal_source.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/plan.h"

namespace trivalent::shell {
namespace {

remesh::ShapeArgument parse_argument(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  remesh::ShapeArgument argument = {.name = std::string(text.substr(0, equals))};
  std::istringstream words(std::string(text.substr(std::min(equals + 1, text.size()))));
  for (std::string word; words >> word;) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    argument.list.push_back(value);
    if (error == std::errc{} && end == word.data() + word.size()) continue;
    argument.list.clear();
    break;
  }
  if (argument.list.empty()) {
    throw remesh::InvalidOption("a shape's parameter is name=number, not '" + std::string(text) +
                                "'");
  }
  if (argument.list.size() == 1) argument.value = std::exchange(argument.list, {}).front();
  return argument;
}

double value_of(const remesh::ShapeParameter& parameter, const ShapeCall& call) {
  for (const remesh::ShapeArgument& argument : call.arguments) {
    if (argument.name == parameter.name) return argument.value;
  }
  return parameter.default_value;
}

/// Short enough for the topology of a shape.
double coarse_edge_length(const ShapeCall& call) {
  double smallest = std::numeric_limits<double>::infinity();
  double pieces = 1.0;
  for (const remesh::ShapeDescription& shape : remesh::built_in_shapes()) {
    if (shape.name != call.name) continue;
    pieces = shape.coarsest;
    for (const remesh::ShapeParameter& parameter : shape.parameters) {
      if (parameter.is_list) continue;
      const double value = value_of(parameter, call);
      if (value != 0.0) smallest = std::min(smallest, std::abs(value));
    }
  }
  return smallest / pieces;
}

/// Edge length of triangles that look smooth to a shell.
///
/// @param coarse  The surface of long triangles, in the supercell.
double fine_edge_length(const remesh::TriMesh& coarse, const dual::ShellOptions& options) {
  constexpr double faces_per_triangle = 4.0;
  constexpr double min_faces = 4000.0;
  const Plan coarse_plan = plan(coarse, options);
  coarse_plan.require_feasible();  // before so many triangles are made
  const double unit_area = remesh::surface_area(coarse) / remesh::unit_triangle_area;
  const double triangles = unit_area / std::pow(coarse_plan.shell.edge_length, 2);
  return std::sqrt(unit_area / std::max(min_faces, faces_per_triangle * triangles));
}

remesh::TriMesh make_fine_shape(const ShapeCall& call, const dual::ShellOptions& options,
                                const std::array<int, 3>& supercell) {
  const remesh::TriMesh coarse =
      remesh::make_shape(call.name, call.arguments, coarse_edge_length(call));
  const double edge_length = fine_edge_length(remesh::repeated(coarse, supercell), options);
  return remesh::repeated(remesh::make_shape(call.name, call.arguments, edge_length), supercell);
}

/// A surface that triangles of any length can be asked for.
struct Triangulated {
  std::function<remesh::TriMesh(double edge_length)> with;
  double first_edge_length;
  std::string_view name;  ///< for notes
};

/// Of triangles so short that shorter ones show no other topology.
Surface resolved(const Triangulated& source, const dual::ShellOptions& options,
                 const std::array<int, 3>& supercell) {
  constexpr double finer = 0.7;
  constexpr int max_refinements = 4;
  double edge_length = source.first_edge_length;
  Surface surface{.mesh = source.with(edge_length)};
  edge_length =
      std::min(edge_length, fine_edge_length(remesh::repeated(surface.mesh, supercell), options));
  surface.mesh = source.with(edge_length);
  for (int i = 0; i < max_refinements; ++i) {
    edge_length *= finer;
    remesh::TriMesh fine = source.with(edge_length);
    const int before = remesh::euler_characteristic(surface.mesh);
    const int after = remesh::euler_characteristic(fine);
    if (before == after) break;
    surface.mesh = std::move(fine);
    if (i + 1 < max_refinements) continue;
    surface.notes.push_back(remesh::concat(
        "the ", source.name, " has details finer than triangles of ", significant(edge_length),
        ": its Euler characteristic still changes, from ", before, " to ", after));
  }
  surface.mesh = remesh::repeated(surface.mesh, supercell);
  return surface;
}

Surface formula_surface(const std::string& text, const dual::ShellOptions& options,
                        const CellOptions& cell) {
  if (!cell.lattice) {
    throw remesh::InvalidOption(
        "a formula needs --cell, in which it repeats, or --box around its closed surface");
  }
  const remesh::Formula formula(text);
  const auto field = [&](const Eigen::Vector3d& p) { return formula(p); };
  constexpr double pieces_of_cell = 20.0;
  return resolved(
      {.with =
           [&](double edge_length) {
             return remesh::level_set(field, cell.level, *cell.lattice, edge_length);
           },
       .first_edge_length = cell.lattice->cell().colwise().norm().minCoeff() / pieces_of_cell,
       .name = "formula"},
      options, cell.supercell);
}

Surface volume_surface(const std::string& path, const dual::ShellOptions& options,
                       remesh::RepairOptions repair, const CellOptions& cell) {
  if (cell.lattice) {
    throw remesh::InvalidOption(path +
                                " has a cell of its own, in which --periodic may make it repeat; "
                                "--cell and --box belong to meshes and formulas");
  }
  const remesh::Volume volume = remesh::read_volume(path, cell.raw);
  // Details are a few points wide. More triangles than this across would be millions.
  constexpr double points_of_edge = 2.0;
  constexpr double most_pieces = 150.0;
  const double longest =
      remesh::lattice_of(volume, cell.periodic).cell().colwise().norm().maxCoeff();
  const double step = volume.steps.colwise().norm().minCoeff();
  Surface surface =
      resolved({.with =
                    [&](double edge_length) {
                      return remesh::level_set(volume, cell.level, cell.periodic, edge_length);
                    },
                .first_edge_length = std::max(points_of_edge * step, longest / most_pieces),
                .name = "volume"},
               options, cell.supercell);
  if (!surface.mesh.lattice.is_periodic()) {
    std::vector<std::string> notes = std::move(surface.notes);
    surface = repair_surface(remesh::soup_of(surface.mesh), options, std::move(repair));
    surface.notes.insert(surface.notes.begin(), notes.begin(), notes.end());
  }
  surface.notes.insert(surface.notes.begin(), volume.notes.begin(), volume.notes.end());
  return surface;
}

std::vector<std::string> comma_separated(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    words.emplace_back(text.substr(0, comma));
    if (comma == text.size()) return words;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

remesh::Lattice::Cell parse_cell(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : comma_separated(text)) {
    numbers.push_back(remesh::number_of_formula(word));
  }
  constexpr std::size_t n_of_vectors = 9;
  if (numbers.size() == n_of_vectors) return Eigen::Map<const Eigen::Matrix3d>(numbers.data());
  if (numbers.size() == 1) numbers.resize(3, numbers[0]);
  if (numbers.size() == 3) numbers.resize(6, 90.0);
  const auto is_length = [](double x) { return x > 0.0; };
  if (numbers.size() != 6 || !std::all_of(numbers.begin(), numbers.begin() + 3, is_length)) {
    throw remesh::InvalidOption(
        "a cell is a, or a,b,c or a,b,c,alpha,beta,gamma with positive "
        "lengths and angles in degree, or nine coordinates of its vectors, not '" +
        text + "'");
  }
  Eigen::Matrix3d cell = dual::cell_of({.lengths = {numbers[0], numbers[1], numbers[2]},
                                        .angles = {numbers[3], numbers[4], numbers[5]}});
  constexpr double flat = 1e-6;  // of a cube's volume
  if (!cell.allFinite() || !(cell.determinant() > flat * numbers[0] * numbers[1] * numbers[2])) {
    throw remesh::InvalidOption("no cell has the angles of '" + text + "'");
  }
  return cell;
}

remesh::RawLayout parse_raw_layout(const std::string& text) {
  const auto refuse = [&] {
    throw remesh::InvalidOption(
        "the layout of raw values is nx,ny,nz,type or nx,ny,nz,type,spacing or "
        "nx,ny,nz,type,a,b,c, as in 64,64,64,uint8,0.5, not '" +
        text + "'");
  };
  const std::vector<std::string> words = comma_separated(text);
  constexpr std::size_t n_sizes = 3;
  if (words.size() != n_sizes + 1 && words.size() != n_sizes + 2 && words.size() != n_sizes + 4) {
    refuse();
  }
  remesh::RawLayout layout;
  for (std::size_t k = 0; k < n_sizes; ++k) {
    const std::string& word = words[k];
    const auto [end, error] =
        std::from_chars(word.data(), word.data() + word.size(), layout.size[k]);
    if (error != std::errc{} || end != word.data() + word.size()) refuse();
  }
  layout.type = words[n_sizes];
  for (std::size_t k = 0; k < 3 && words.size() > n_sizes + 1; ++k) {
    const std::string& word = words[words.size() == n_sizes + 2 ? n_sizes + 1 : n_sizes + 1 + k];
    layout.spacing[static_cast<Eigen::Index>(k)] = remesh::number_of_formula(word);
  }
  return layout;
}

Surface in_cell(Surface surface, const CellOptions& cell) {
  if (cell.lattice && !cell.lattice->is_periodic()) {
    throw remesh::InvalidOption("a box belongs to a formula; a mesh takes a cell");
  }
  if (cell.lattice) {
    const bool is_named = cell.periodic != remesh::Lattice::Periodic{};
    const remesh::Lattice lattice(cell.lattice->cell(),
                                  is_named ? cell.periodic : cell.lattice->periodic());
    surface.mesh = remesh::joined_in_cell(std::move(surface.mesh), lattice);
    const auto open =
        std::ranges::count_if(surface.mesh.edges(), [](const auto e) { return e.is_boundary(); });
    if (open > 0) {
      surface.notes.push_back(std::to_string(open) +
                              " sides of triangles have no partner in the cell: the surface has an "
                              "open edge there");
    }
  }
  surface.mesh = remesh::repeated(surface.mesh, cell.supercell);
  return surface;
}

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
                     remesh::RepairOptions repair, const CellOptions& cell) {
  if (is_ideal_structure(source)) {
    throw remesh::InvalidOption(source +
                                " is no surface but atoms already: relax, energy, view, "
                                "lammps and the others take it in place of a file");
  }
  const bool is_file = !is_built_in(source) && !source.starts_with(formula_prefix);
  const bool is_volume = is_file && remesh::is_volume_file(source);
  const bool is_mesh = is_file && !is_volume;
  if (!is_volume && cell.raw) {
    throw remesh::InvalidOption(source + " is no volume, which --raw belongs to");
  }
  if (!is_volume && !(is_mesh && cell.lattice) && cell.periodic != remesh::Lattice::Periodic{}) {
    throw remesh::InvalidOption(source +
                                " is neither a volume nor a mesh with a cell, which --periodic "
                                "belongs to; the cell of a mesh is given by --cell");
  }
  if (is_built_in(source)) {
    if (cell.lattice) {
      throw remesh::InvalidOption(source +
                                  " has a cell of its own, or none; --cell and --box "
                                  "belong to mesh files and formulas");
    }
    return {.mesh = make_fine_shape(parse_shape(source), shell, cell.supercell)};
  }
  if (source.starts_with(formula_prefix)) {
    return formula_surface(source.substr(formula_prefix.size()), shell, cell);
  }
  if (is_volume) {
    return volume_surface(source, shell, std::move(repair), cell);
  }
  return in_cell(repair_surface(read_soup(source), shell, std::move(repair)), cell);
}

}  // namespace trivalent::shell
