#include "cell_options.h"
#include "command.h"
#include "files.h"
#include "repair_options.h"
#include "session.h"
#include "size_options.h"
#include "trivalent/remesh/error.h"
#include "trivalent/shell/inspect.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::apps {
namespace {

void add_target(const remesh::MeshQuality& quality, double target, Result& result) {
  const double ratio = quality.edge_length.mean / target;
  result.table.push_back({"mean edge / wanted", shell::decimals(ratio, 4)});
  result.json["target_edge_length"] = target;
  result.json["mean_over_target"] = ratio;
}

Grammar grammar_of_inspect() {
  Grammar grammar = {.arguments = {"MESH"}, .options = po::options_description("Options")};
  grammar.options.add_options()                                                     //
      ("against", po::value<std::string>(), "mesh file to measure distances from")  //
      ("edge", po::value<double>(), "wanted edge length to compare with, in units of the mesh");
  po::options_description repair("Planned repair");
  add_repair_options(repair);
  po::options_description size("Planned shell");
  add_shell_size_options(size);
  po::options_description cell("Cell");
  add_mesh_cell_options(cell);
  grammar.options.add(repair).add(size).add(cell);
  grammar.epilog =
      "Exit codes: 0 sound, 1 mendable (build does it, or says how), 3 hopeless.\n"
      "Indices count from 0, in the order of the file.\n";
  return grammar;
}

int exit_code_of(shell::Verdict verdict) {
  constexpr int nothing_to_build_on = 3;
  switch (verdict) {
    case shell::Verdict::sound:
      return done;
    case shell::Verdict::mendable:
      return failed;
    case shell::Verdict::hopeless:
      break;
  }
  return nothing_to_build_on;
}

int run_inspect(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_inspect());
  if (!session) return done;
  const shell::InspectOptions options = {
      .shell = {.size = shell_size(*session),
                .bond = session->find<double>("bond").value_or(dual::default_bond_length),
                .method = {}},
      .repair = repair_options(*session),
      .cell = mesh_cell_options(*session)};
  const auto target = session->find<double>("edge");
  if (target && !(*target > 0.0)) throw UsageError("--edge must be > 0");

  const auto& path = session->get<std::string>("MESH");
  const shell::Inspection inspection = shell::inspect(path, options);
  session->terminal.notes(inspection.reading_notes);
  Result result = {.table = inspection.rows(), .json = inspection.json()};
  result.json["file"] = path;
  if (target && inspection.mesh) add_target(inspection.quality, *target, result);
  if (const auto original = session->find<std::string>("against")) {
    if (!inspection.mesh) throw remesh::InvalidMesh("inspect: " + inspection.reason);
    const auto distance =
        remesh::measure_distance(*inspection.mesh, read_mesh_file(*original, session->terminal));
    shell::append(result.table, shell::distance_rows(distance));
    result.json["against"] = *original;
    result.json["distance"] = shell::distance_json(distance);
  }
  session->terminal.print(result);
  return exit_code_of(inspection.verdict);
}

}  // namespace

const Command inspect_command = {
    .name = "inspect",
    .synopsis = "MESH [--against ORIGINAL] [--edge m] [--atoms N] [--repair none|safe|wrap]",
    .meaning = "Tells all about a mesh: what is wrong, what build would do, how regular it is",
    .run = run_inspect};

}  // namespace trivalent::apps
