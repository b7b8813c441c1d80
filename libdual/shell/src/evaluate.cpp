#include "trivalent/shell/evaluate.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "trivalent/dual/columns.h"
#include "trivalent/dual/error.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"
#include "trivalent/shell/wall_energies.h"

namespace trivalent::shell {
namespace {

potentials::EnergyForces energy_of(const potentials::Atoms& atoms, const EvaluateOptions& options) {
  if (!options.lammps) return make_potential(options.potential)->evaluate(atoms);
  return run_lammps(atoms, {}, lammps_options("evaluate", options.potential, *options.lammps))
      .result;
}

std::map<int, int> coordinations_of(const dual::ShellState& state) {
  std::map<int, int> coordinations;
  for (const double count : state.find("coordination")->values) {
    ++coordinations[static_cast<int>(count)];
  }
  return coordinations;
}

double largest_force(const potentials::EnergyForces& energy) {
  double largest = 0.0;
  for (const Eigen::Vector3d& force : energy.forces) largest = std::max(largest, force.norm());
  return largest;
}

void add_walls(const EvaluateOptions& options, Evaluation& result) {
  result.walls = dual::check_walls(result.state.structure);
  if (result.walls.empty() || options.lammps) return;
  result.wall_energies = wall_energies(result.state.structure, result.energy.energies,
                                       *make_potential(options.potential));
  result.state.maps.push_back(dual::wall_energy_map(result.wall_energies));
}

}  // namespace

Evaluation evaluate(dual::Structure structure, const EvaluateOptions& options) {
  if (options.n_worst < 0) throw dual::InvalidOption("evaluate: n_worst must be >= 0");
  Evaluation result = {.potential = options.potential.title(), .forces = options.forces};
  if (structure.bonds.empty()) result.bonds = BondSource::distance;
  result.energy = energy_of(structure.atoms, options);
  result.summary = dual::summarize_energies(result.energy.energies, options.n_worst);
  result.state = dual::shell_state("atoms", std::move(structure));
  dual::add_energies(result.state, result.energy.energies, graphene_reference(options.potential));
  add_walls(options, result);
  return result;
}

dual::Structure Evaluation::structure() const {
  dual::Structure structure = state.structure;
  dual::replace_columns(structure, dual::network_columns(structure));
  dual::add_energies(structure, energy);
  set_potential(structure, potential);
  if (bonds == BondSource::distance) structure.bonds.clear();
  if (forces == ForceReport::none) {
    std::erase_if(structure.columns,
                  [](const dual::Column& column) { return column.name == "forces"; });
  }
  return structure;
}

Json Evaluation::json() const {
  Json json = {{"potential", potential},
               {"unit", "eV"},
               {"atoms", state.structure.atoms.size()},
               {"energy", energy.energy},
               {"energy_per_atom", summary.mean}};
  if (is_rebo({.name = potential})) json["excess_per_atom"] = summary.excess();
  json["lowest"] = summary.lowest;
  json["highest"] = summary.highest;
  json["worst"] = Json::array();
  for (const int atom : summary.worst) {
    json["worst"].push_back({{"id", atom + 1},
                             {"energy", energy.energies[atom]},
                             {"position", vector_json(state.structure.atoms.positions[atom])}});
  }
  json["bonds_from"] = bonds == BondSource::file ? "file" : "distance";
  json["coordinations"] = histogram_json(coordinations_of(state));
  json["ring_sizes"] = histogram_json(state.ring_sizes);
  if (!walls.empty()) json["walls"] = walls_json(walls, wall_energies);
  if (forces == ForceReport::none) return json;
  json["largest_force"] = largest_force(energy);
  json["energies"] = energy.energies;
  json["forces"] = Json::array();
  for (const Eigen::Vector3d& force : energy.forces) json["forces"].push_back(vector_json(force));
  return json;
}

std::vector<dual::TableRow> Evaluation::rows() const {
  std::vector<dual::TableRow> rows = {{"potential", potential},
                                      {"atoms", std::to_string(state.structure.atoms.size())},
                                      {"energy", decimals(energy.energy, 8) + " eV"},
                                      {"per atom", decimals(summary.mean, 8) + " eV"}};
  if (is_rebo({.name = potential})) {
    rows.push_back({"above graphene", decimals(1000.0 * summary.excess(), 3) + " meV/atom"});
  }
  rows.push_back({"lowest, highest atom",
                  decimals(summary.lowest, 4) + ", " + decimals(summary.highest, 4) + " eV"});
  for (const int atom : summary.worst) {
    const Eigen::Vector3d& position = state.structure.atoms.positions[atom];
    rows.push_back({"atom " + std::to_string(atom + 1),
                    decimals(energy.energies[atom], 4) + " eV at " + decimals(position.x(), 3) +
                        " " + decimals(position.y(), 3) + " " + decimals(position.z(), 3)});
  }
  rows.push_back({"bonds", bonds == BondSource::file ? "as the file says" : "found by distance"});
  rows.push_back({"atoms by bonds", histogram_text(coordinations_of(state))});
  rows.push_back({"rings by size", histogram_text(state.ring_sizes)});
  if (forces == ForceReport::all) {
    rows.push_back({"largest force", significant(largest_force(energy), 6) + " eV/Å"});
  }
  append(rows, walls_rows(walls, wall_energies));
  return rows;
}

}  // namespace trivalent::shell
