#include <nlohmann/json.hpp>

#include "pair_text.h"
#include "trivalent/shell/certify.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"
#include "trivalent/shell/wall_energies.h"

namespace trivalent::shell {
namespace {

Json pair_json(const std::optional<dual::AtomPair>& pair) {
  if (!pair) return nullptr;
  return {{"ids", {pair->atoms[0] + 1, pair->atoms[1] + 1}}, {"distance", pair->distance}};
}

Json angle_json(const std::optional<dual::BondAngle>& angle) {
  if (!angle) return nullptr;
  return {{"id", angle->atom + 1}, {"angle", angle->angle}};
}

std::vector<dual::TableRow> topology_rows(const dual::ShellReport& shell) {
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

std::vector<dual::TableRow> energy_rows(const Certificate& certificate) {
  std::string per_atom = decimals(certificate.summary.mean, 8) + " eV";
  if (is_rebo({.name = certificate.potential})) {
    per_atom += ", above graphene " + decimals(1000.0 * certificate.summary.excess(), 3) + " meV";
  }
  std::string worst;
  for (const int atom : certificate.summary.worst) {
    worst += (worst.empty() ? "" : ", ") + decimals(certificate.energy.energies[atom], 4) + " (" +
             std::to_string(atom + 1) + ')';
  }
  std::string potential = certificate.potential;
  if (certificate.other_potential) {
    potential += "; the file's energies are of " + *certificate.other_potential + ": not compared";
  }
  return {{"potential", potential},
          {"energy", decimals(certificate.energy.energy, 8) + " eV"},
          {"per atom", per_atom},
          {"worst atoms [eV]", worst},
          {"largest force", significant(certificate.largest_force) + " eV/Å"}};
}

}  // namespace

std::string pair_text(const std::optional<dual::AtomPair>& pair) {
  if (!pair) return "none";
  return decimals(pair->distance, 3) + " (" + std::to_string(pair->atoms[0] + 1) + '-' +
         std::to_string(pair->atoms[1] + 1) + ')';
}

std::string angle_text(const std::optional<dual::BondAngle>& angle) {
  if (!angle) return "none";
  return decimals(angle->angle, 1) + "° (" + std::to_string(angle->atom + 1) + ')';
}

Json Certificate::json() const {
  Json json = {{"sound", is_sound()},
               {"problems", problems},
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
               {"bonds_from", bonds == BondSource::file ? "file" : "distance"},
               {"potential", potential},
               {"energy", energy.energy},
               {"energy_per_atom", summary.mean},
               {"largest_force", largest_force}};
  if (shell.is_closed()) json["euler_characteristic"] = shell.euler_characteristic();
  if (other_potential) json["potential_of_file"] = *other_potential;
  if (is_rebo({.name = potential})) json["excess_per_atom"] = summary.excess();
  json["worst"] = Json::array();
  for (const int atom : summary.worst) {
    json["worst"].push_back({{"id", atom + 1}, {"energy", energy.energies[atom]}});
  }
  if (!walls.empty()) json["walls"] = walls_json(walls, {});
  if (surface_distance) {
    json["surface_distance"] = {{"rms", surface_distance->rms},
                                {"largest", surface_distance->largest}};
  }
  if (lammps) {
    json["lammps"] = {{"energy_difference", lammps->energy}, {"force_difference", lammps->force}};
  }
  return json;
}

std::vector<dual::TableRow> Certificate::rows() const {
  std::vector<dual::TableRow> rows = topology_rows(shell);
  rows.push_back({"bonds are found", bonds == BondSource::file
                                         ? "by distance, and compared with those of the file"
                                         : "by distance; the file has none"});
  append(rows, walls_rows(walls, {}));
  if (!walls.empty()) rows.push_back({"all walls"});
  append(rows, energy_rows(*this));
  if (surface_distance) {
    rows.push_back({"to the surface [Å]", "rms " + decimals(surface_distance->rms, 3) +
                                              ", at most " +
                                              decimals(surface_distance->largest, 3)});
  }
  if (lammps) {
    rows.push_back({"LAMMPS differs by", significant(lammps->energy, 3) + " eV, " +
                                             significant(lammps->force, 3) + " eV/Å at most"});
  }
  for (const std::string& problem : problems) rows.push_back({"wrong", problem});
  if (problems.empty()) rows.push_back({"result", "sound"});
  return rows;
}

}  // namespace trivalent::shell
