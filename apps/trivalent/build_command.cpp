#include <chrono>
#include <filesystem>
#include <optional>
#include <ostream>
#include <utility>

#include "build_options.h"
#include "command.h"
#include "files.h"
#include "relax_line.h"
#include "remesh_options.h"
#include "report_page.h"
#include "session.h"
#include "trivalent/remesh/whole_file.h"
#include "trivalent/shell/plan.h"
#include "trivalent/shell/surface_source.h"
#include "viewer_page.h"

namespace trivalent::apps {
namespace {

shell::Surface read_surface(const BuildRequest& request) {
  return shell::read_surface(request.shape, request.build.shell, request.repair, request.cell);
}

int plan_only(const BuildRequest& request, const Terminal& terminal) {
  const shell::Surface surface = read_surface(request);
  terminal.notes(surface.notes);
  const shell::Plan plan = shell::plan(surface.mesh, request.build.shell);
  terminal.print({.table = plan.rows(), .json = plan.json()});
  return plan.obstacles.empty() ? done : failed;
}

Json report_json(const BuildRequest& request, const Json& options,
                 const shell::BuildResult& result) {
  Json report = {{"program", "trivalent"},
                 {"version", TRIVALENT_VERSION},
                 {"input", request.shape},
                 {"options", options}};
  report.update(result.json());
  return report;
}

/// Seconds since it was last asked.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

int run_build(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_build());
  if (!session) return done;
  BuildRequest request = build_request(*session);
  if (session->has("dry-run")) return plan_only(request, session->terminal);
  if (!session->has("output")) throw UsageError("-o must say into which folder the results go");
  const std::filesystem::path folder = session->get<std::string>("output");
  check_folder(folder);

  Stopwatch stopwatch;
  shell::Surface surface = read_surface(request);
  const double read_seconds = stopwatch.lap();
  remesh::RemeshMethod& method = request.build.shell.method;
  // Before the first step a signal ends the program.
  std::optional<StopRequest> stop;
  request.build.on_step = [&](shell::BuildStep step) {
    if (!stop) stop_with(method, stop.emplace());
    if (step == shell::BuildStep::relax) stop->keep_results();
  };
  RelaxLine line(session->terminal);
  request.build.on_relax = [&](const potentials::RelaxProgress& state) {
    line.show(state);
    return !stop->is_made();
  };
  shell::BuildResult result = shell::build(std::move(surface), request.build);
  result.seconds.emplace(result.seconds.begin(), "read", read_seconds);

  stopwatch.lap();
  const OutputFolder made(folder);
  shell::write_build(folder, result, request.files);
  result.seconds.emplace_back("write", stopwatch.lap());
  const Json options = options_json(*session);
  Result printed = {.table = result.rows(), .json = report_json(request, options, result)};
  remesh::write_whole_file(folder / "report.json",
                           [&](std::ostream& out) { out << shell::json_text(printed.json); });
  session->terminal.notes(result.notes);
  shell::write_build_page(folder / "report.html", std::move(result),
                          {.title = std::filesystem::path(request.shape).filename().string(),
                           .program = program_name,
                           .parameters = page_rows(options),
                           .viewer = viewer_page});
  printed.table.push_back({"results"});
  printed.table.push_back({"folder", folder.string()});
  session->terminal.print(printed);
  return stop->exit_code();
}

}  // namespace

const Command build_command = {
    .name = "build",
    .synopsis = "SHAPE -o DIR [--atoms N | --length L | --scale s] [options]",
    .meaning = "Turns a shape into a carbon shell with energies and LAMMPS files: the whole way",
    .run = run_build};

}  // namespace trivalent::apps
