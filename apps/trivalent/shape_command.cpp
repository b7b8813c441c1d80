#include "command.h"
#include "files.h"
#include "session.h"
#include "trivalent/remesh/mesh_io.h"
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

int run(const Command& self, std::span<const std::string> arguments) {
  Grammar grammar = {.arguments = {"NAME", "OUT"}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("edge", with_default(default_edge_length),
       "edge length of the triangles, in units of the shape");
  grammar.epilog = shapes_help();
  const auto session = start(self, arguments, grammar);
  if (!session) return done;

  const auto& output = session->get<std::string>("OUT");
  check_output(output, mesh_extensions);
  const shell::ShapeCall call = shell::parse_shape(session->get<std::string>("NAME"));
  const remesh::TriMesh mesh =
      remesh::make_shape(call.name, call.arguments, session->get<double>("edge"));
  remesh::write_mesh(mesh, output);
  session->terminal.print(describe(mesh, output));
  return done;
}

}  // namespace

const Command shape_command = {
    .name = "shape",
    .synopsis = "NAME[:parameter=value,...] OUT [--edge l]",
    .meaning = "Writes a built-in shape as a mesh file (OFF, OBJ, PLY, STL)",
    .run = run};

}  // namespace trivalent::apps
