#include <filesystem>
#include <optional>

#include "command.h"
#include "file_options.h"
#include "files.h"
#include "interruption.h"
#include "relax_line.h"
#include "relax_options.h"
#include "session.h"
#include "structure_options.h"
#include "trivalent/formats/structure_format.h"

namespace trivalent::apps {
namespace {

int run_relax(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_relax());
  if (!session) return done;
  if (!session->has("output")) throw UsageError("-o must say into which file the result goes");
  const auto& output = session->get<std::string>("output");
  check_structure_output(output);
  const dual::Digits precision = digits(*session);
  shell::RelaxOptions options = relax_options(*session);
  const auto& network = session->get<std::string>("NETWORK");
  dual::Structure structure =
      read_structure(network, structure_options(*session), session->terminal);

  std::optional<StopRequest> stop;
  if (!options.lammps) stop.emplace();
  RelaxLine line(session->terminal);
  options.on_progress = [&](const potentials::RelaxProgress& state) {
    line.show(state);
    return !stop->is_made();
  };
  const shell::RelaxedStructure result = shell::relax(std::move(structure), options);
  const std::vector<std::string> notes_of_file =
      dual::write_structure(output, result.structure, {.digits = precision});
  const int exit_code = stop ? stop->exit_code() : done;
  // A run that was stopped can be taken up again.
  if (exit_code == done && options.checkpoint) std::filesystem::remove(*options.checkpoint);
  session->terminal.notes(result.notes);
  session->terminal.notes(notes_of_file);
  Result printed = {.table = result.rows(), .json = {{"network", network}}};
  printed.json.update(result.json());
  session->terminal.print(printed);
  return exit_code == done && !result.relaxed.converged ? not_at_rest : exit_code;
}

}  // namespace

const Command relax_command = {
    .name = "relax",
    .synopsis = "NETWORK -o OUT.extxyz [--max-force F] [--minimizer lbfgs|fire] [options]",
    .meaning = "Brings atoms, or the dual of a mesh, to rest",
    .run = run_relax};

}  // namespace trivalent::apps
