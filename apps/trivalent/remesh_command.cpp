#include "command.h"
#include "files.h"
#include "remesh_options.h"
#include "repair_options.h"
#include "session.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/shell/build.h"
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
  return grammar;
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_remesh());
  if (!session) return done;
  if (!session->has("edge")) throw UsageError("--edge must say how long edges are to be");
  const auto edge = session->get<double>("edge");
  remesh::RemeshMethod method = remesh_method(*session);
  const auto& output = session->get<std::string>("OUT");
  check_output(output, mesh_extensions);

  remesh::RepairOptions repair = repair_options(*session);
  repair.edge_length_on = [edge](const remesh::TriMesh&) { return edge; };
  const remesh::RepairResult input =
      remesh::repair(shell::read_soup(session->get<std::string>("IN")), repair);
  session->terminal.notes(input.notes);
  const remesh::TriMesh& original = input.mesh;
  std::optional<StopRequest> stop;
  if (can_stop_early(method)) stop_with(method, stop.emplace());
  const remesh::RemeshResult remeshed = remesh::remesh_by(original, method, edge);
  const int exit_code = remeshed.stopped ? stop->exit_code() : done;
  stop.reset();
  if (remeshed.stopped) session->terminal.note("note: " + shell::stopped_note(remeshed));
  remesh::write_mesh(remeshed.mesh, output);

  const auto quality = remesh::measure_quality(remeshed.mesh);
  const auto distance = remesh::measure_distance(remeshed.mesh, original);
  Result result = {.table = {{"wrote", output}}, .json = {{"file", output}}};
  shell::append(result.table, shell::quality_rows(quality));
  shell::append(result.table, shell::net_rows(remeshed));
  shell::append(result.table, shell::distance_rows(distance));
  result.json["notes"] = input.notes;
  result.json["wrap_offset"] = input.offset;
  result.json["iterations"] = remeshed.iterations;
  result.json["net"] = shell::net_json(remeshed);
  result.json["stopped"] = remeshed.stopped;
  result.json["target_edge_length"] = edge;
  result.json["quality"] = shell::quality_json(quality);
  result.json["distance"] = shell::distance_json(distance);
  session->terminal.print(result);
  return exit_code;
}

}  // namespace

const Command remesh_command = {
    .name = "remesh",
    .synopsis = "IN OUT --edge m [options]",
    .meaning = "Remeshes a surface until all edges come close to one length",
    .run = run};

}  // namespace trivalent::apps
