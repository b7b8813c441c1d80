#include "trivalent/shell/states.h"

#include "trivalent/dual/energy_summary.h"
#include "trivalent/shell/evaluate.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

std::vector<dual::TableRow> energy_rows(const std::vector<dual::ShellState>& states) {
  std::vector<dual::TableRow> rows;
  for (const dual::ShellState& state : states) {
    const auto summary = dual::summarize_energies(state.find("energy")->values, 0);
    rows.push_back({state.name});
    rows.push_back({"atoms", std::to_string(state.structure.atoms.size())});
    rows.push_back({"energy", decimals(summary.total, 6) + " eV"});
    rows.push_back({"per atom", decimals(summary.mean, 6) + " eV"});
    rows.push_back({"lowest, highest",
                    decimals(summary.lowest, 4) + ", " + decimals(summary.highest, 4) + " eV"});
  }
  return rows;
}

}  // namespace

std::vector<dual::ShellState> evaluate_states(std::vector<NamedStructure> structures,
                                              const PotentialChoice& potential) {
  std::vector<dual::ShellState> states;
  for (NamedStructure& each : structures) {
    states.push_back(evaluate(std::move(each.structure), {.potential = potential}).state);
    states.back().name = std::move(each.name);
  }
  const potentials::Atoms& first = states.front().structure.atoms;
  const potentials::Atoms& last = states.back().structure.atoms;
  if (states.size() > 1 && first.species == last.species) {
    states.back().maps.push_back(dual::displacement_map(first.positions, last.positions));
  }
  return states;
}

dual::ShellPage page_of(std::vector<dual::ShellState> states, const PotentialChoice& potential) {
  dual::ShellPage page = {.title = states.back().name, .states = std::move(states)};
  page.results = energy_rows(page.states);
  page.parameters = {{"potential", potential.name}};
  return page;
}

}  // namespace trivalent::shell
