#include "trivalent/shell/relax_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include "trivalent/shell/names.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

// Pairs of ids as in files, from 1.
Json ids_json(const std::vector<potentials::Bond>& bonds) {
  Json json = Json::array();
  for (const auto& bond : bonds) json.push_back({bond.first + 1, bond.second + 1});
  return json;
}

std::string ids_text(const std::vector<potentials::Bond>& bonds) {
  constexpr std::size_t max_bonds = 5;
  return first_of(bonds, max_bonds, [](const potentials::Bond& bond) {
    return std::to_string(bond.first + 1) + '-' + std::to_string(bond.second + 1);
  });
}

std::string_view name_of(potentials::RelaxEnd end) {
  using potentials::RelaxEnd;
  constexpr Names<RelaxEnd, 6> names = {{{"at rest", RelaxEnd::at_rest},
                                         {"the energy has settled", RelaxEnd::energy_settled},
                                         {"stopped", RelaxEnd::stopped},
                                         {"no step lowers the energy", RelaxEnd::no_descent},
                                         {"bonds are held", RelaxEnd::bonds_held},
                                         {"out of steps", RelaxEnd::out_of_steps}}};
  return shell::name_of(end, names);
}

std::map<int, int> atoms_by_coordination(const RelaxReport& report) {
  std::map<int, int> counts;
  for (const int coordination : report.bonds.coordinations) ++counts[coordination];
  return counts;
}

}  // namespace

RelaxReport report_relaxation(std::span<const Eigen::Vector3d> before,
                              std::span<const potentials::Bond> bonds,
                              const potentials::RelaxResult& relaxed) {
  RelaxReport report;
  report.bonds = potentials::bond_changes(relaxed.atoms, bonds);
  double squares = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double square = (relaxed.atoms.positions[i] - before[i]).squaredNorm();
    squares += square;
    report.displacement_largest = std::max(report.displacement_largest, std::sqrt(square));
  }
  if (!before.empty()) {
    report.displacement_rms = std::sqrt(squares / static_cast<double>(before.size()));
  }
  return report;
}

Json relax_json(const RelaxReport& report, const potentials::RelaxResult& relaxed) {
  Json coordinations = Json::object();
  for (const auto& [coordination, count] : atoms_by_coordination(report)) {
    coordinations[std::to_string(coordination)] = count;
  }
  return {{"converged", relaxed.converged},
          {"end", name_of(relaxed.end)},
          {"steps", relaxed.steps},
          {"evaluations", relaxed.evaluations},
          {"largest_force", relaxed.largest_force},
          {"displacement_rms", report.displacement_rms},
          {"displacement_largest", report.displacement_largest},
          {"bonds_broken", ids_json(report.bonds.broken)},
          {"bonds_formed", ids_json(report.bonds.formed)},
          {"bonds_held", ids_json(relaxed.held)},
          {"coordinations", coordinations}};
}

std::vector<dual::TableRow> relax_rows(const RelaxReport& report,
                                       const potentials::RelaxResult& relaxed) {
  std::string coordinations;
  for (const auto& [coordination, count] : atoms_by_coordination(report)) {
    coordinations += (coordinations.empty() ? "" : ", ") + std::to_string(count) + " with " +
                     std::to_string(coordination);
  }
  return {{"ended", std::string(name_of(relaxed.end))},
          {"steps", std::to_string(relaxed.steps) + " (" + std::to_string(relaxed.evaluations) +
                        " evaluations)"},
          {"largest force", significant(relaxed.largest_force) + " eV/Å"},
          {"atoms moved by [Å]", "rms " + decimals(report.displacement_rms, 3) + ", at most " +
                                     decimals(report.displacement_largest, 3)},
          {"bonds broken, formed", std::to_string(report.bonds.broken.size()) + ", " +
                                       std::to_string(report.bonds.formed.size())},
          {"atoms by neighbors", coordinations}};
}

std::string guess_note(const potentials::GuessedBonds& guess) {
  std::string note = "the input names no bonds: " + std::to_string(guess.bonds.size()) +
                     " are guessed from distances";
  if (!guess.ambiguous.empty()) {
    note +=
        "; ambiguous are " + std::to_string(guess.ambiguous.size()) +
        " more pairs that close, of atoms that have all their bonds: " + ids_text(guess.ambiguous);
  }
  return note;
}

std::vector<std::string> relax_notes(const RelaxReport& report,
                                     const potentials::RelaxResult& relaxed) {
  std::vector<std::string> notes;
  if (!relaxed.converged) {
    notes.push_back("the relaxation did not converge (" + std::string(name_of(relaxed.end)) +
                    "): the largest force is " + significant(relaxed.largest_force) +
                    " eV/Å after " + std::to_string(relaxed.steps) + " steps");
  }
  if (!relaxed.held.empty()) {
    notes.push_back(std::to_string(relaxed.held.size()) +
                    " bonds are held by springs, since REBO would tear them: between atoms " +
                    ids_text(relaxed.held));
  }
  const auto& bonds = report.bonds;
  if (!bonds.broken.empty()) {
    notes.push_back(std::to_string(bonds.broken.size()) +
                    " bonds of the network broke, between atoms " + ids_text(bonds.broken));
  }
  if (!bonds.formed.empty()) {
    notes.push_back(std::to_string(bonds.formed.size()) +
                    " pairs without a bond are within its reach (C-C 2 Å): atoms " +
                    ids_text(bonds.formed));
  }
  return notes;
}

std::string_view name_of(potentials::RelaxStage stage) {
  using potentials::RelaxStage;
  constexpr Names<RelaxStage, 5> names = {{{"trial of the potential", RelaxStage::trial},
                                           {"springs", RelaxStage::springs},
                                           {"potential and springs", RelaxStage::guarded},
                                           {"potential, holding bonds", RelaxStage::held},
                                           {"potential", RelaxStage::free}}};
  return shell::name_of(stage, names);
}

}  // namespace trivalent::shell
