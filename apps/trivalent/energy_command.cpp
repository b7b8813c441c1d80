#include <algorithm>
#include <map>

#include "command.h"
#include "files.h"
#include "lammps_engine.h"
#include "potential_options.h"
#include "reports.h"
#include "session.h"
#include "shell_files.h"
#include "structure.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/view/energy_ply.h"
#include "trivalent/view/shell_state.h"
#include "trivalent/view/vtp.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 4> energy_extensions = {".extxyz", ".xyz", ".ply", ".vtp"};

Grammar grammar_of_energy() {
  Grammar grammar = {.arguments = {"FILE"}, .options = po::options_description("Options")};
  add_potential_options(grammar.options);
  add_engine_options(grammar.options);
  grammar.options.add_options()                    //
      ("forces", "report forces, and write them")  //
      ("output,o", po::value<std::string>(),
       "write energies per atom: .extxyz; .ply with colors; .vtp with all scalars")  //
      ("worst", with_default(5), "how many atoms of highest energy to list, >= 0")   //
      ("digits", with_default(std::string("decimals")), "of the output: decimals or 17");
  add_structure_options(grammar.options);
  return grammar;
}

void write_atoms(const dual::ShellState& state, const potentials::EnergyForces& energy,
                 const Session& session) {
  dual::Structure structure = state.structure;
  dual::replace_columns(structure, dual::network_columns(structure));
  dual::add_energies(structure, energy);
  if (!session.has("forces")) {
    std::erase_if(structure.columns,
                  [](const dual::Column& column) { return column.name == "forces"; });
  }
  dual::write_xyz(session.get<std::string>("output"), structure, digits(session));
}

void write_result(const dual::ShellState& state, const potentials::EnergyForces& energy,
                  const Session& session) {
  const std::filesystem::path output = session.get<std::string>("output");
  const std::string extension = extension_of(output);
  if (extension == ".vtp") {
    dual::write_vtp(output, state);
  } else if (extension == ".ply") {
    dual::write_energy_ply(output, state.structure, energy.energies,
                           {.scale = state.find("energy")->scale});
  } else {
    write_atoms(state, energy, session);
  }
}

void add_network(const dual::ShellState& state, Result& result) {
  std::map<int, int> coordinations;
  for (const double count : state.find("coordination")->values) {
    ++coordinations[static_cast<int>(count)];
  }
  result.table.push_back({"atoms by bonds", histogram_text(coordinations)});
  result.table.push_back({"rings by size", histogram_text(state.ring_sizes)});
  result.json["coordinations"] = histogram_json(coordinations);
  result.json["ring_sizes"] = histogram_json(state.ring_sizes);
}

void add_worst_atoms(const dual::ShellState& state, const potentials::EnergyForces& energy,
                     const dual::EnergySummary& summary, Result& result) {
  result.json["worst"] = Json::array();
  for (const int atom : summary.worst) {
    const Eigen::Vector3d& position = state.structure.atoms.positions[atom];
    const int id = atom + 1;
    result.json["worst"].push_back({{"id", id},
                                    {"energy", energy.energies[atom]},
                                    {"position", {position.x(), position.y(), position.z()}}});
    result.table.push_back({"atom " + std::to_string(id),
                            decimals(energy.energies[atom], 4) + " eV at " +
                                decimals(position.x(), 3) + " " + decimals(position.y(), 3) + " " +
                                decimals(position.z(), 3)});
  }
}

void add_forces(const potentials::EnergyForces& energy, Result& result) {
  double largest = 0.0;
  Json forces = Json::array();
  for (const Eigen::Vector3d& force : energy.forces) {
    largest = std::max(largest, force.norm());
    forces.push_back({force.x(), force.y(), force.z()});
  }
  result.table.push_back({"largest force", significant(largest, 6) + " eV/Å"});
  result.json["largest_force"] = largest;
  result.json["energies"] = energy.energies;
  result.json["forces"] = std::move(forces);
}

Result describe(const dual::ShellState& state, const potentials::EnergyForces& energy,
                const Session& session) {
  const auto summary = dual::summarize_energies(energy.energies, session.get<int>("worst"));
  const auto& potential = session.get<std::string>("potential");
  Result result = {.table = {{"potential", potential},
                             {"atoms", std::to_string(state.structure.atoms.size())},
                             {"energy", decimals(energy.energy, 8) + " eV"},
                             {"per atom", decimals(summary.mean, 8) + " eV"}},
                   .json = {{"file", session.get<std::string>("FILE")},
                            {"potential", potential},
                            {"unit", "eV"},
                            {"atoms", state.structure.atoms.size()},
                            {"energy", energy.energy},
                            {"energy_per_atom", summary.mean}}};
  if (is_rebo(session)) {
    result.table.push_back(
        {"above graphene", decimals(1000.0 * summary.excess(), 3) + " meV/atom"});
    result.json["excess_per_atom"] = summary.excess();
  }
  result.table.push_back({"lowest, highest atom", decimals(summary.lowest, 4) + ", " +
                                                      decimals(summary.highest, 4) + " eV"});
  result.json["lowest"] = summary.lowest;
  result.json["highest"] = summary.highest;
  add_worst_atoms(state, energy, summary, result);
  add_network(state, result);
  if (session.has("forces")) add_forces(energy, result);
  return result;
}

void check_options(const Session& session) {
  if (session.get<int>("worst") < 0) throw UsageError("--worst must be >= 0");
  static_cast<void>(digits(session));
  check_structure_options(session);
  check_potential(session);
  check_engine(session);
  if (session.has("output")) {
    check_output(session.get<std::string>("output"), energy_extensions);
  }
}

potentials::EnergyForces energy_of(const potentials::Atoms& atoms, const Session& session) {
  if (!uses_lammps(session)) return evaluate(atoms, session);
  const auto folder = std::filesystem::temp_directory_path() / "trivalent-lammps";
  return run_lammps(atoms, {}, folder, session).result;
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_energy());
  if (!session) return done;
  check_options(*session);
  dual::ShellState state =
      dual::shell_state("atoms", read_structure(session->get<std::string>("FILE"), *session));
  const potentials::EnergyForces energy = energy_of(state.structure.atoms, *session);
  dual::add_energies(state, energy.energies, graphene_reference(*session));
  if (session->has("output")) write_result(state, energy, *session);
  session->terminal.print(describe(state, energy, *session));
  return done;
}

}  // namespace

const Command energy_command = {
    .name = "energy",
    .synopsis =
        "FILE.extxyz|FILE.data|MESH [--potential rebo|airebo|lj] [--forces] [-o OUT] [options]",
    .meaning = "Computes energies and forces of atoms, or of the dual of a mesh",
    .run = run};

}  // namespace trivalent::apps
