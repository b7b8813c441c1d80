#include "build_report.h"

#include <algorithm>
#include <filesystem>

#include "report_page.h"
#include "trivalent/dual/energy_summary.h"

namespace trivalent::apps {
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

Json options_json(const Session& session) {
  Json json = Json::object();
  for (const auto& [name, value] : session.values) {
    if (const auto* text = boost::any_cast<std::string>(&value.value())) json[name] = *text;
    if (const auto* number = boost::any_cast<double>(&value.value())) json[name] = *number;
    if (const auto* count = boost::any_cast<int>(&value.value())) json[name] = *count;
  }
  return json;
}

std::string energy_text(const dual::EnergySummary& summary) {
  return "mean " + decimals(summary.mean, 4) + ", worst " + decimals(summary.highest, 4) +
         " eV, above graphene " + decimals(1000.0 * summary.excess(), 1) + " meV/atom";
}

}  // namespace

Json report_json(const BuildRecord& record, const Session& session) {
  const auto after = summary_of(record.after);
  Json json = {{"program", "trivalent"},
               {"version", TRIVALENT_VERSION},
               {"input", session.get<std::string>("SHAPE")},
               {"options", options_json(session)},
               {"notes", record.notes},
               {"wrap_offset", record.wrap_offset},
               {"scale", record.shell.scale},
               {"target_edge_length", record.shell.target_edge_length * record.shell.scale},
               {"remeshings", record.shell.remeshings},
               {"iterations", record.shell.surface.iterations},
               {"net", net_json(record.shell.surface)},
               {"input_quality", quality_json(record.input_quality)},
               {"quality", quality_json(record.quality)},
               {"components", components_json(record.components)},
               {"distance", distance_json(record.distance)},
               {"network", network_json(record.network)},
               {"hydrogens", record.caps.hydrogens}};
  json["energy"] = {{"potential", "rebo"}, {"unit", "eV"}, {"after", energy_json(after)}};
  json["energy"]["before"] =
      record.before ? energy_json(summary_of(*record.before)) : Json(nullptr);
  if (record.relaxed) {
    json["energy"]["unrelaxed"] = energy_json(summary_of(*record.unrelaxed));
    json["relaxation"] = relax_json(record.relaxation, *record.relaxed);
  }
  json["energy"]["scale"] = scale_json(record.after.find("energy")->scale);
  json["seconds"] = record.stopwatch.seconds();
  return json;
}

std::vector<TableRow> summary_rows(const BuildRecord& record) {
  std::vector<TableRow> rows = {{"surface [Å]"}};
  append(rows, quality_rows(record.quality));
  append(rows, net_rows(record.shell.surface));
  append(rows, components_rows(record.components));
  append(rows, distance_rows(record.distance));
  rows.push_back({"shell"});
  append(rows, network_rows(record.network));
  rows.push_back({"REBO energy per atom"});
  if (record.before) {
    rows.push_back({record.before->name, energy_text(summary_of(*record.before))});
  }
  if (record.unrelaxed) {
    rows.push_back({record.unrelaxed->name, energy_text(summary_of(*record.unrelaxed))});
  }
  const auto after = summary_of(record.after);
  rows.push_back({record.after.name, energy_text(after)});
  rows.push_back({"total", decimals(after.total, 8) + " eV"});
  if (record.relaxed) {
    rows.push_back({"relaxation"});
    append(rows, relax_rows(record.relaxation, *record.relaxed));
  }
  return rows;
}

dual::ShellPage report_page(BuildRecord& record, const Session& session) {
  const std::string& shape = session.get<std::string>("SHAPE");
  dual::ShellPage page = {.title = std::filesystem::path(shape).filename().string(),
                          .notes = record.notes,
                          .parameters = page_rows(options_json(session)),
                          .results = page_rows(summary_rows(record))};
  // A dual much larger than the shell would only weigh the page down.
  constexpr std::size_t always_welcome = 250000;
  if (record.before && record.before->structure.atoms.size() <=
                           std::max(always_welcome, record.after.structure.atoms.size())) {
    page.states.push_back(std::move(*record.before));
  } else if (record.before) {
    page.notes.push_back("the dual of the input has " +
                         std::to_string(record.before->structure.atoms.size()) +
                         " atoms, too many to be shown beside the shell");
  }
  // Three states of a large shell would make the page slow to open.
  constexpr std::size_t most_unrelaxed = 100000;
  if (record.unrelaxed && record.unrelaxed->structure.atoms.size() <= most_unrelaxed) {
    page.states.push_back(std::move(*record.unrelaxed));
  } else if (record.unrelaxed) {
    page.notes.push_back("the shell is too large for its page to show it before relaxation too");
  }
  page.states.push_back(std::move(record.after));
  page.surface = std::move(record.original);
  return page;
}

}  // namespace trivalent::apps
