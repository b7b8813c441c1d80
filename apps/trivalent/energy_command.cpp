#include <array>
#include <filesystem>

#include "command.h"
#include "file_options.h"
#include "files.h"
#include "lammps_options.h"
#include "potential_options.h"
#include "session.h"
#include "structure_options.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/shell/evaluate.h"
#include "trivalent/view/energy_ply.h"
#include "trivalent/view/vtp.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 2> map_extensions = {".ply", ".vtp"};

Grammar grammar_of_energy() {
  Grammar grammar = {.arguments = {"FILE"}, .options = po::options_description("Options")};
  add_potential_options(grammar.options);
  add_engine_options(grammar.options);
  grammar.options.add_options()                    //
      ("forces", "report forces, and write them")  //
      ("output,o", po::value<std::string>(),
       "write energies per atom: .extxyz or another format of atoms; .ply with colors; .vtp with "
       "all scalars")  //
      ("worst", with_default(5), "how many atoms of highest energy to list, >= 0");
  add_digits_option(grammar.options);
  add_structure_options(grammar.options);
  return grammar;
}

shell::EvaluateOptions evaluate_options(const Session& session) {
  if (session.get<int>("worst") < 0) throw UsageError("--worst must be >= 0");
  const shell::PotentialChoice potential = potential_choice(session);
  return {.potential = potential,
          .lammps = engine_options(session, potential),
          .n_worst = session.get<int>("worst"),
          .forces = session.has("forces") ? shell::ForceReport::all : shell::ForceReport::none};
}

std::vector<std::string> write_result(const std::filesystem::path& output,
                                      const shell::Evaluation& result, dual::Digits precision) {
  const std::string extension = extension_of(output);
  if (extension == ".vtp") {
    dual::write_vtp(output, result.state);
    return {};
  }
  if (extension == ".ply") {
    dual::write_energy_ply(output, result.state.structure, result.energy.energies,
                           {.scale = result.state.find("energy")->scale});
    return {};
  }
  return dual::write_structure(output, result.structure(), {.digits = precision});
}

int run_energy(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_energy());
  if (!session) return done;
  const dual::Digits precision = digits(*session);
  const auto output = session->find<std::string>("output");
  if (output) check_structure_output(*output, map_extensions);
  const shell::EvaluateOptions options = evaluate_options(*session);
  const auto& file = session->get<std::string>("FILE");
  const shell::Evaluation result = shell::evaluate(
      read_structure(file, structure_options(*session), session->terminal), options);
  if (output) session->terminal.notes(write_result(*output, result, precision));
  Result printed = {.table = result.rows(), .json = {{"file", file}}};
  printed.json.update(result.json());
  session->terminal.print(printed);
  return done;
}

}  // namespace

const Command energy_command = {
    .name = "energy",
    .synopsis =
        "FILE.extxyz|FILE.data|MESH [--potential rebo|airebo|lj] [--forces] [-o OUT] [options]",
    .meaning = "Computes energies and forces of atoms, or of the dual of a mesh",
    .run = run_energy};

}  // namespace trivalent::apps
