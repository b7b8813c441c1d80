#include "command.h"
#include "files.h"
#include "inspection.h"
#include "reports.h"
#include "session.h"
#include "size_options.h"
#include "surface_input.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::apps {
namespace {

void add_target(const remesh::MeshQuality& quality, double target, Result& result) {
  const double ratio = quality.edge_length.mean / target;
  result.table.push_back({"mean edge / wanted", decimals(ratio, 4)});
  result.json["target_edge_length"] = target;
  result.json["mean_over_target"] = ratio;
}

Grammar grammar_of_inspect() {
  Grammar grammar = {.arguments = {"MESH"}, .options = po::options_description("Options")};
  grammar.options.add_options()                                                     //
      ("against", po::value<std::string>(), "mesh file to measure distances from")  //
      ("edge", po::value<double>(), "wanted edge length to compare with, in units of the mesh");
  po::options_description mending("Repair that is thought of");
  add_repair_options(mending);
  po::options_description size("Shell that is thought of");
  add_shell_size_options(size);
  grammar.options.add(mending).add(size);
  grammar.epilog =
      "Exit codes: 0 sound, 1 mendable (build does it, or says how), 3 hopeless.\n"
      "Indices count from 0, in the order of the file.\n";
  return grammar;
}

int exit_code_of(Verdict verdict) {
  constexpr int nothing_to_build_on = 3;
  switch (verdict) {
    case Verdict::sound:
      return done;
    case Verdict::mendable:
      return failed;
    case Verdict::hopeless:
      break;
  }
  return nothing_to_build_on;
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_inspect());
  if (!session) return done;
  static_cast<void>(repair_options(*session));
  static_cast<void>(shell_size(*session));
  const auto target = session->find<double>("edge");
  if (target && !(*target > 0.0)) throw UsageError("--edge must be > 0");

  const auto& path = session->get<std::string>("MESH");
  const Inspection inspection = inspect(path, *session);
  session->terminal.notes(inspection.reading_notes);
  Result result = describe(inspection);
  result.json["file"] = path;
  if (target && inspection.mesh) add_target(inspection.quality, *target, result);
  if (const auto original = session->find<std::string>("against")) {
    if (!inspection.mesh) throw remesh::InvalidMesh("inspect: " + inspection.reason);
    const auto distance =
        remesh::measure_distance(*inspection.mesh, read_mesh_file(*original, session->terminal));
    append(result.table, distance_rows(distance));
    result.json["against"] = *original;
    result.json["distance"] = distance_json(distance);
  }
  session->terminal.print(result);
  return exit_code_of(inspection.verdict);
}

}  // namespace

const Command inspect_command = {
    .name = "inspect",
    .synopsis = "MESH [--against ORIGINAL] [--edge m] [--atoms N] [--repair none|safe|wrap]",
    .meaning = "Tells all about a mesh: what is wrong, what build would do, how regular it is",
    .run = run};

}  // namespace trivalent::apps
