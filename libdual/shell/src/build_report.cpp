#include <algorithm>
#include <nlohmann/json.hpp>

#include "trivalent/dual/energy_summary.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::shell {
namespace {

dual::EnergySummary summary_of(const dual::ShellState& state) {
  return dual::summarize_energies(state.find("energy")->values, 0);
}

Json energy_json(const dual::EnergySummary& summary) {
  return {{"energy", summary.total},
          {"energy_per_atom", summary.mean},
          {"excess_per_atom", summary.excess()},
          {"lowest", summary.lowest},
          {"highest", summary.highest}};
}

std::string energy_text(const dual::EnergySummary& summary) {
  return "mean " + decimals(summary.mean, 4) + ", worst " + decimals(summary.highest, 4) +
         " eV, above graphene " + decimals(1000.0 * summary.excess(), 1) + " meV/atom";
}

Json energies_json(const BuildResult& result) {
  Json json = {
      {"potential", "rebo"}, {"unit", "eV"}, {"after", energy_json(summary_of(result.after))}};
  json["before"] = result.before ? energy_json(summary_of(*result.before)) : Json(nullptr);
  if (result.relaxed) json["unrelaxed"] = energy_json(summary_of(*result.unrelaxed));
  json["scale"] = scale_json(result.after.find("energy")->scale);
  return json;
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
               {"hydrogens", caps.hydrogens},
               {"energy", energies_json(*this)}};
  json["energy"]["budget"] = budget.json();
  if (relaxed) {
    json["relaxation"] = relax_json(relaxation, *relaxed);
    if (distance_at_rest) json["relaxation"]["distance"] = distance_json(*distance_at_rest);
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
  rows.push_back({"REBO energy per atom"});
  for (const auto* state : {&before, &unrelaxed}) {
    if (*state) rows.push_back({(*state)->name, energy_text(summary_of(**state))});
  }
  const auto summary = summary_of(after);
  rows.push_back({after.name, energy_text(summary)});
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
