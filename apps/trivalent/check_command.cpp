#include <algorithm>
#include <cmath>

#include "certificate.h"
#include "command.h"
#include "files.h"
#include "lammps_engine.h"
#include "potential_options.h"
#include "reports.h"
#include "session.h"
#include "structure.h"

namespace trivalent::apps {
namespace {

Grammar grammar_of_check() {
  Grammar grammar = {
      .arguments = {}, .options = po::options_description("Options"), .list = "FILE"};
  grammar.options.add_options()  //
      ("max-force", with_default(0.01),
       "atoms are at rest if none has a larger force [eV/Å], > 0; inf: not looked at")  //
      ("open", "the shell has an edge: atoms with two bonds are meant")                 //
      ("surface", po::value<std::string>(),
       "mesh, in Å, from which the atoms' distances are measured (surface.off of a build)")  //
      ("lammps", "let LAMMPS compute energies and forces too, and compare them atom by atom");
  add_lammps_options(grammar.options);
  add_potential_options(grammar.options);
  add_structure_options(grammar.options);
  grammar.epilog =
      "FILE is extended XYZ, LAMMPS data or a mesh, whose dual is meant. Atoms are bonded if they\n"
      "are nearer than 1.85 Å (C-C), 1.55 Å (C-H), 1.4 Å (H-H). Exit code 1 if something is "
      "wrong:\n"
      "an atom without its three bonds, a bond outside 1.25 to 1.75 Å, an angle outside 85° to "
      "155°,\n"
      "other atoms nearer than 2 Å, a ring missing, forces, energies that are not those of the "
      "file.\n";
  return grammar;
}

Json pair_json(const dual::AtomPair& pair) {
  if (pair.atoms[0] < 0) return nullptr;
  return {{"ids", {pair.atoms[0] + 1, pair.atoms[1] + 1}}, {"distance", pair.distance}};
}

Json angle_json(const dual::BondAngle& angle) {
  if (angle.atom < 0) return nullptr;
  return {{"id", angle.atom + 1}, {"angle", angle.angle}};
}

struct DistanceSummary {
  double rms = 0.0;
  double largest = 0.0;
};

DistanceSummary summarize(const std::vector<double>& distances) {
  DistanceSummary summary;
  for (const double distance : distances) {
    summary.rms += distance * distance;
    summary.largest = std::max(summary.largest, distance);
  }
  summary.rms = std::sqrt(summary.rms / static_cast<double>(distances.size()));
  return summary;
}

Json json_of(const Certificate& certificate, const Session& session) {
  const dual::ShellReport& shell = certificate.shell;
  Json json = {{"file", certificate.file},
               {"sound", certificate.problems.empty()},
               {"problems", certificate.problems},
               {"atoms", shell.atoms},
               {"bonds", shell.bonds},
               {"pieces", shell.pieces},
               {"is_closed", shell.is_closed()},
               {"coordinations", histogram_json(shell.coordinations)},
               {"ring_sizes", histogram_json(shell.ring_sizes)},
               {"shortest_bond", pair_json(shell.shortest_bond)},
               {"longest_bond", pair_json(shell.longest_bond)},
               {"smallest_angle", angle_json(shell.smallest_angle)},
               {"largest_angle", angle_json(shell.largest_angle)},
               {"closest_non_bonded", pair_json(shell.closest_non_bonded)},
               {"potential", session.get<std::string>("potential")},
               {"energy", certificate.energy.energy},
               {"energy_per_atom", certificate.summary.mean},
               {"largest_force", certificate.largest_force}};
  if (shell.is_closed()) json["euler_characteristic"] = shell.euler_characteristic();
  if (is_rebo(session)) json["excess_per_atom"] = certificate.summary.excess();
  json["worst"] = Json::array();
  for (const int atom : certificate.summary.worst) {
    json["worst"].push_back({{"id", atom + 1}, {"energy", certificate.energy.energies[atom]}});
  }
  if (!certificate.surface_distances.empty()) {
    const auto [rms, largest] = summarize(certificate.surface_distances);
    json["surface_distance"] = {{"rms", rms}, {"largest", largest}};
  }
  if (certificate.energy_difference) {
    json["lammps"] = {{"energy_difference", *certificate.energy_difference},
                      {"force_difference", *certificate.force_difference}};
  }
  return json;
}

std::vector<TableRow> topology_rows(const dual::ShellReport& shell) {
  std::string surface = "not closed";
  if (shell.is_closed()) {
    surface = "closed, Euler characteristic " + std::to_string(shell.euler_characteristic());
  }
  return {{"atoms, bonds, rings", std::to_string(shell.atoms) + ", " + std::to_string(shell.bonds) +
                                      ", " + std::to_string(shell.ring_count())},
          {"surface",
           surface + (shell.pieces == 1 ? "" : ", in " + std::to_string(shell.pieces) + " pieces")},
          {"atoms by bonds", histogram_text(shell.coordinations)},
          {"rings by size", histogram_text(shell.ring_sizes)},
          {"bonds [Å]", pair_text(shell.shortest_bond) + " to " + pair_text(shell.longest_bond)},
          {"angles", angle_text(shell.smallest_angle) + " to " + angle_text(shell.largest_angle)},
          {"closest without bond", pair_text(shell.closest_non_bonded)}};
}

std::vector<TableRow> energy_rows(const Certificate& certificate, const Session& session) {
  std::string per_atom = decimals(certificate.summary.mean, 8) + " eV";
  if (is_rebo(session)) {
    per_atom += ", above graphene " + decimals(1000.0 * certificate.summary.excess(), 3) + " meV";
  }
  std::string worst;
  for (const int atom : certificate.summary.worst) {
    worst += (worst.empty() ? "" : ", ") + decimals(certificate.energy.energies[atom], 4) + " (" +
             std::to_string(atom + 1) + ')';
  }
  return {{"energy", decimals(certificate.energy.energy, 8) + " eV"},
          {"per atom", per_atom},
          {"worst atoms [eV]", worst},
          {"largest force", significant(certificate.largest_force) + " eV/Å"}};
}

std::vector<TableRow> rows_of(const Certificate& certificate, const Session& session) {
  std::vector<TableRow> rows = {{certificate.file}};
  append(rows, topology_rows(certificate.shell));
  append(rows, energy_rows(certificate, session));
  if (!certificate.surface_distances.empty()) {
    const auto [rms, largest] = summarize(certificate.surface_distances);
    rows.push_back(
        {"to the surface [Å]", "rms " + decimals(rms, 3) + ", at most " + decimals(largest, 3)});
  }
  if (certificate.energy_difference) {
    rows.push_back({"LAMMPS differs by", significant(*certificate.energy_difference, 3) + " eV, " +
                                             significant(*certificate.force_difference, 3) +
                                             " eV/Å at most"});
  }
  for (const std::string& problem : certificate.problems) rows.push_back({"wrong", problem});
  if (certificate.problems.empty()) rows.push_back({"result", "sound"});
  return rows;
}

void check_options(const Session& session) {
  if (!(session.get<double>("max-force") > 0.0)) throw UsageError("--max-force must be > 0");
  check_structure_options(session);
  check_potential(session);
  if (session.has("lammps")) {
    check_lammps(session);
  } else if (session.get<int>("ranks") != 1 || session.has("potential-file")) {
    throw UsageError("--ranks and --potential-file go with --lammps");
  }
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_check());
  if (!session) return done;
  check_options(*session);
  std::optional<remesh::TriMesh> surface;
  if (const auto path = session->find<std::string>("surface")) {
    surface = read_mesh_file(*path, session->terminal);
  }
  Result result = {.table = {}, .json = {{"sound", true}, {"files", Json::array()}}};
  bool is_sound = true;
  for (const auto& file : session->get<std::vector<std::string>>("FILE")) {
    const Certificate certificate = certify(file, surface, *session);
    is_sound = is_sound && certificate.problems.empty();
    append(result.table, rows_of(certificate, *session));
    result.json["files"].push_back(json_of(certificate, *session));
  }
  result.json["sound"] = is_sound;
  session->terminal.print(result);
  return is_sound ? done : failed;
}

}  // namespace

const Command check_command = {
    .name = "check",
    .synopsis = "FILE... [--surface MESH] [--lammps [--ranks N]] [options]",
    .meaning = "Certifies shells: topology, bonds, rings, energies, forces; also against LAMMPS",
    .run = run};

}  // namespace trivalent::apps
