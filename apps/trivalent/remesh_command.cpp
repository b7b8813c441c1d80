#include "cell_options.h"
#include "command.h"
#include "files.h"
#include "remesh_options.h"
#include "repair_options.h"
#include "session.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/remesh_surface.h"
#include "trivalent/shell/reports.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::apps {
namespace {

Grammar grammar_of_remesh() {
  Grammar grammar = {.arguments = {"IN", "OUT"}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("edge", po::value<double>(),
       "m, the wanted edge length in units of the mesh; must be given");
  add_remesh_options(grammar.options);
  add_repair_options(grammar.options);
  add_mesh_cell_options(grammar.options);
  return grammar;
}

int run_remesh(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_remesh());
  if (!session) return done;
  if (!session->has("edge")) throw UsageError("--edge must say how long edges are to be");
  const auto edge = session->get<double>("edge");
  shell::RemeshSurfaceOptions options = {.target_edge_length = edge,
                                         .method = remesh_method(*session),
                                         .repair = repair_options(*session),
                                         .cell = mesh_cell_options(*session)};
  const auto& output = session->get<std::string>("OUT");
  check_output(output, mesh_extensions);

  // Until the search begins there is nothing that a stop could keep: a signal ends the program.
  std::optional<StopRequest> stop;
  int exit_code = done;
  options.on_step = [&](shell::RemeshStep step) {
    if (step == shell::RemeshStep::remesh) {
      stop_with(options.method, stop.emplace());
      return;
    }
    if (stop) exit_code = stop->exit_code();
    stop.reset();
  };
  const shell::RemeshedSurface remeshed =
      shell::remesh_surface(shell::read_soup(session->get<std::string>("IN")), options);
  session->terminal.notes(remeshed.notes);
  if (remeshed.net.stopped) session->terminal.note("note: " + shell::stopped_note(remeshed.net));
  remesh::write_mesh(remeshed.net.mesh, output);

  Result result = {.table = {{"wrote", output}}, .json = {{"file", output}}};
  shell::append(result.table, remeshed.rows());
  result.json.update(remeshed.json());
  session->terminal.print(result);
  return remeshed.net.stopped ? exit_code : done;
}

}  // namespace

const Command remesh_command = {
    .name = "remesh",
    .synopsis = "IN OUT --edge m [options]",
    .meaning = "Remeshes a surface until all edges come close to one length",
    .run = run_remesh};

}  // namespace trivalent::apps
