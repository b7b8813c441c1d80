#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "trivalent/dual/energy_summary.h"
#include "trivalent/formats/cell_angles.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"
#include "trivalent/shell/wall_energies.h"

namespace trivalent::shell {
namespace {

dual::EnergySummary summary_of(const dual::ShellState& state) {
  return dual::summarize_energies(state.find("energy")->values, 0);
}

/// @param graphene  an atom's energy there [eV]
Json energy_json(const dual::EnergySummary& summary, double graphene) {
  return {{"energy", summary.total},
          {"energy_per_atom", summary.mean},
          {"excess_per_atom", summary.mean - graphene},
          {"lowest", summary.lowest},
          {"highest", summary.highest}};
}

std::string energy_text(const dual::EnergySummary& summary, double graphene) {
  return "mean " + decimals(summary.mean, 4) + ", worst " + decimals(summary.highest, 4) +
         " eV, above graphene " + decimals(1000.0 * (summary.mean - graphene), 1) + " meV/atom";
}

Json energies_json(const BuildResult& result) {
  const auto of_state = [&](const dual::ShellState& state) {
    return energy_json(summary_of(state), result.graphene);
  };
  Json json = {{"potential", result.potential.title()},
               {"unit", "eV"},
               {"graphene", result.graphene},
               {"after", of_state(result.after)}};
  json["before"] = result.before ? of_state(*result.before) : Json(nullptr);
  if (result.relaxed) json["unrelaxed"] = of_state(*result.unrelaxed);
  json["scale"] = scale_json(result.after.find("energy")->scale);
  return json;
}

/// The cell of a periodic shell, and what is in it.
struct CellReport {
  dual::CellAngles cell;
  double area;                    ///< of the net, before its atoms were relaxed [Å²]
  std::optional<double> density;  ///< [g/cm³]; none where a direction is free
  int genus;                      ///< of the net, for a cell
};

std::optional<CellReport> cell_report(const BuildResult& result) {
  const potentials::Atoms& atoms = result.shell.structure.atoms;
  if (!atoms.box.is_periodic()) return std::nullopt;
  constexpr double grams_per_cubic_cm = 1.66053907;  // of an atomic mass unit per Å³
  constexpr double carbon_mass = 12.011;
  CellReport report{
      .cell = dual::cell_angles(atoms.box.cell),
      .area = remesh::surface_area(result.shell.surface.mesh),
      .density = std::nullopt,
      .genus = result.quality.components -
               (result.quality.euler_characteristic + result.quality.boundary_loops) / 2};
  if (std::ranges::all_of(atoms.box.periodic, [](bool along) { return along; })) {
    report.density = grams_per_cubic_cm * carbon_mass * static_cast<double>(atoms.size()) /
                     std::abs(atoms.box.cell.determinant());
  }
  return report;
}

Json cell_json(const CellReport& report, const potentials::Box& box) {
  return {{"lengths", report.cell.lengths},
          {"angles", report.cell.angles},
          {"periodic", box.periodic},
          {"area", report.area},
          {"density", report.density ? Json(*report.density) : Json(nullptr)},
          {"genus", report.genus}};
}

Json tube_ends_json(const std::vector<std::optional<remesh::ChiralIndices>>& ends) {
  Json json = Json::array();
  for (const auto& tube : ends) {
    json.push_back(tube ? Json({tube->n, tube->m}) : Json(nullptr));
  }
  return json;
}

std::string tube_ends_text(const std::vector<std::optional<remesh::ChiralIndices>>& ends) {
  std::string text;
  for (const auto& tube : ends) {
    text += (text.empty() ? "" : ", ") + (tube ? tube_text(*tube) : "no tube");
  }
  return text;
}

void add_rows(const CellReport& report, std::vector<dual::TableRow>& rows) {
  const auto three = [](const std::array<double, 3>& numbers, int digits) {
    return decimals(numbers[0], digits) + ", " + decimals(numbers[1], digits) + ", " +
           decimals(numbers[2], digits);
  };
  rows.push_back({"cell"});
  rows.push_back({"a, b, c [Å]", three(report.cell.lengths, 4)});
  rows.push_back({"α, β, γ", three(report.cell.angles, 2) + "°"});
  rows.push_back({"area of the net", decimals(report.area, 1) + " Å², not relaxed"});
  if (report.density) rows.push_back({"density", decimals(*report.density, 4) + " g/cm³"});
  rows.push_back({"genus", std::to_string(report.genus)});
}

}  // namespace

Json BuildResult::json() const {
  Json json = {{"notes", notes},
               {"wrap_offset", wrap_offset},
               {"scale", shell.scale},
               {"target_edge_length", shell.target_edge_length * shell.scale},
               {"remeshings", shell.remeshings},
               {"iterations", shell.surface.iterations},
               {"net", net_json(shell.surface)},
               {"input_quality", quality_json(input_quality)},
               {"quality", quality_json(quality)},
               {"components", components_json(components)},
               {"distance", distance_json(distance)},
               {"network", network_json(network)},
               {"tube_ends", tube_ends_json(tube_ends)},
               {"hydrogens", caps.hydrogens},
               {"energy", energies_json(*this)}};
  json["energy"]["budget"] = budget.json();
  if (!walls.empty()) json["walls"] = walls_json(walls, wall_energies);
  if (relaxed) {
    json["relaxation"] = relax_json(relaxation, *relaxed);
    if (distance_at_rest) json["relaxation"]["distance"] = distance_json(*distance_at_rest);
  }
  if (const auto cell = cell_report(*this)) {
    json["cell"] = cell_json(*cell, this->shell.structure.atoms.box);
  }
  json["seconds"] = Json::object();
  for (const auto& [step, time] : seconds) json["seconds"][step] = time;
  return json;
}

std::vector<dual::TableRow> BuildResult::rows() const {
  std::vector<dual::TableRow> rows = {{"surface [Å]"}};
  append(rows, quality_rows(quality));
  append(rows, net_rows(shell.surface));
  append(rows, components_rows(components));
  append(rows, distance_rows(distance));
  rows.push_back({"shell"});
  append(rows, network_rows(network));
  if (std::ranges::any_of(tube_ends, [](const auto& tube) { return tube.has_value(); })) {
    rows.push_back({"open ends", tube_ends_text(tube_ends)});
  }
  if (const auto cell = cell_report(*this)) add_rows(*cell, rows);
  append(rows, walls_rows(walls, wall_energies));
  rows.push_back({"energy per atom (" + potential.title() + ")"});
  for (const auto* state : {&before, &unrelaxed}) {
    if (*state) rows.push_back({(*state)->name, energy_text(summary_of(**state), graphene)});
  }
  const auto summary = summary_of(after);
  rows.push_back({after.name, energy_text(summary, graphene)});
  rows.push_back({"total", decimals(summary.total, 8) + " eV"});
  if (relaxed) {
    rows.push_back({"relaxation"});
    append(rows, relax_rows(relaxation, *relaxed));
    if (distance_at_rest) append(rows, distance_rows(*distance_at_rest));
  }
  rows.push_back({"energy above graphene"});
  append(rows, budget.rows());
  return rows;
}

}  // namespace trivalent::shell
