#include "command.h"
#include "files.h"
#include "session.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/tube_ends.h"
#include "trivalent/shell/ideal_source.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::apps {
namespace {

/// In units of the shape, whose own measures are about 1.
constexpr double default_edge_length = 0.05;

Result describe(const remesh::TriMesh& mesh, const std::string& output) {
  return {.table = {{"wrote", output},
                    {"vertices", std::to_string(mesh.n_vertices())},
                    {"faces", std::to_string(mesh.n_faces())},
                    {"mean edge", shell::significant(remesh::mean_edge_length(mesh))}},
          .json = {{"file", output},
                   {"vertices", mesh.n_vertices()},
                   {"faces", mesh.n_faces()},
                   {"mean_edge_length", remesh::mean_edge_length(mesh)},
                   {"area", remesh::surface_area(mesh)}}};
}

/// The options that say of a mesh file which cell it shows.
std::string cell_options_of(const remesh::Lattice& lattice) {
  remesh::Lattice::Cell cell = lattice.cell();
  std::string directions;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (lattice.periodic()[k]) directions += "xyz"[k];
    if (cell.col(column).isZero()) cell(column, column) = 1.0;  // any vector will do
  }
  constexpr int digits = 12;
  std::string text;
  if (cell.isDiagonal(0.0)) {
    for (const double length : cell.diagonal()) text += ',' + shell::significant(length, digits);
  } else {
    for (const double number : cell.reshaped()) text += ',' + shell::significant(number, digits);
  }
  text = "--cell " + text.substr(1);
  return directions == "xyz" ? text : text + " --periodic " + directions;
}

/// What a surface has that no mesh file holds.
std::vector<std::string> notes_on_loss(const remesh::TriMesh& mesh) {
  std::vector<std::string> notes;
  if (mesh.lattice.is_periodic()) {
    notes.push_back("mesh files hold no cell; to read this one, add " +
                    cell_options_of(mesh.lattice));
  }
  if (remesh::edge_length_of_tubes(mesh)) {
    notes.emplace_back(
        "mesh files do not say which nanotubes the arms end in; for a net with these, build the "
        "shape by its name");
  }
  return notes;
}

void write_ideal(const Session& session) {
  const auto& output = session.get<std::string>("OUT");
  if (!session.values["edge"].defaulted()) {
    throw UsageError("--edge belongs to meshes; ideal structures have bonds of their own length");
  }
  check_structure_output(output);
  const dual::Structure structure = shell::make_ideal_structure(session.get<std::string>("NAME"));
  const std::vector<std::string> notes = dual::write_structure(output, structure);
  session.terminal.notes(notes);
  session.terminal.print(describe_written(output, structure, notes));
}

int run_shape(const Command& self, std::span<const std::string> arguments) {
  Grammar grammar = {.arguments = {"NAME", "OUT"}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("edge", with_default(default_edge_length),
       "edge length of the triangles, in units of the shape");
  grammar.epilog = shapes_help() + '\n' + ideal_structures_help();
  const auto session = start(self, arguments, grammar);
  if (!session) return done;

  const auto& name = session->get<std::string>("NAME");
  const auto& output = session->get<std::string>("OUT");
  if (shell::is_ideal_structure(name)) {
    write_ideal(*session);
    return done;
  }
  check_output(output, mesh_extensions);
  const shell::ShapeCall call = shell::parse_shape(name);
  const remesh::TriMesh mesh =
      remesh::make_shape(call.name, call.arguments, session->get<double>("edge"));
  remesh::write_mesh(mesh, output);
  session->terminal.notes(notes_on_loss(mesh));
  session->terminal.print(describe(mesh, output));
  return done;
}

}  // namespace

const Command shape_command = {
    .name = "shape",
    .synopsis = "NAME[:parameter=value,...] OUT [--edge l]",
    .meaning =
        "Writes a built-in shape as a mesh (OFF, OBJ, PLY, STL), or an ideal structure as atoms",
    .run = run_shape};

}  // namespace trivalent::apps
