#include "trivalent/shell/potential_choice.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::shell {
namespace {

using PotentialPointer = std::unique_ptr<potentials::Potential>;

const std::string potential_key = "potential";  // in headers of extended XYZ

// A new potential is a row here.
constexpr std::array potentials_by_name = {
    KnownPotential{.name = "rebo",
                   .meaning = "second-generation REBO",
                   .make = [](const PotentialChoice&) -> PotentialPointer {
                     return std::make_unique<potentials::Rebo>();
                   },
                   .lammps = dual::LammpsPotential::rebo},
    KnownPotential{.name = "airebo",
                   .meaning = "AIREBO with all its terms",
                   .make = [](const PotentialChoice&) -> PotentialPointer {
                     return std::make_unique<potentials::Airebo>();
                   },
                   .lammps = dual::LammpsPotential::airebo},
    KnownPotential{.name = "lj",
                   .meaning = "Lennard-Jones",
                   .make = [](const PotentialChoice& choice) -> PotentialPointer {
                     return std::make_unique<potentials::LennardJones>(choice.lennard_jones);
                   },
                   .lammps = std::nullopt},
};

std::string list_of_names() {
  std::string list;
  for (const KnownPotential& each : potentials_by_name) {
    if (!list.empty()) list += &each == &potentials_by_name.back() ? " or " : ", ";
    list += each.name;
  }
  return list;
}

}  // namespace

std::span<const KnownPotential> known_potentials() { return potentials_by_name; }

const KnownPotential& find_potential(const PotentialChoice& choice) {
  const auto found = std::ranges::find(potentials_by_name, choice.name, &KnownPotential::name);
  if (found != potentials_by_name.end()) return *found;
  throw dual::InvalidOption("the potential is " + list_of_names() + ", not '" + choice.name + "'");
}

PotentialPointer make_potential(const PotentialChoice& choice) {
  if (choice.pair_style) {
    throw dual::InvalidOption("only LAMMPS computes " + choice.title() +
                              "; --engine lammps asks it");
  }
  return find_potential(choice).make(choice);
}

LammpsOptions lammps_options(std::string_view caller, const PotentialChoice& choice,
                             LammpsOptions options) {
  options.pair_style = choice.pair_style;
  if (choice.pair_style) return options;
  const auto same = find_potential(choice).lammps;
  if (!same) {
    throw dual::InvalidOption(std::string(caller) + ": LAMMPS is not asked for the potential " +
                              choice.name);
  }
  options.potential = *same;
  return options;
}

std::string exact_text(const PotentialChoice& choice) {
  const auto& lj = choice.lennard_jones;
  std::ostringstream text;
  text.precision(17);
  text << choice.title() << ' ' << lj.epsilon << ' ' << lj.sigma << ' ' << lj.cutoff << ' '
       << lj.shift;
  return text.str();
}

double graphene_reference(const PotentialChoice& choice) {
  if (choice.pair_style) return 0.0;
  if (is_rebo(choice)) return dual::graphene_energy;
  const potentials::Atoms cell = dual::graphene_cell();
  const auto n_atoms = static_cast<double>(cell.size());
  const PotentialPointer potential = make_potential(choice);
  // Pairs alone, without bonds, would not keep a net.
  if (choice.name == "lj") return potential->evaluate(cell).energy / n_atoms;
  return potentials::relax(cell, *potential, {.box = potentials::BoxPolicy::pressure_free})
             .result.energy /
         n_atoms;
}

double usual_bond_length(const PotentialChoice& choice) {
  constexpr double airebo_bond = 1.397;
  return choice.title() == "airebo" ? airebo_bond : dual::default_bond_length;
}

bool is_rebo(const PotentialChoice& choice) { return choice.title() == "rebo"; }

void set_potential(dual::Structure& structure, const std::string& title) {
  std::erase_if(structure.header,
                [](const dual::HeaderEntry& entry) { return entry.key == potential_key; });
  if (title == PotentialChoice().name) return;
  structure.header.push_back({.key = potential_key, .value = title});
}

std::optional<std::string> potential_title(const dual::Structure& structure) {
  const auto entry = std::ranges::find(structure.header, potential_key, &dual::HeaderEntry::key);
  if (entry == structure.header.end()) return std::nullopt;
  const auto* const title = std::get_if<std::string>(&entry->value);
  return title == nullptr ? std::nullopt : std::optional(*title);
}

std::optional<PotentialChoice> named_potential(const dual::Structure& structure) {
  const std::optional<std::string> name = potential_title(structure);
  if (!name) return std::nullopt;
  const auto known = std::ranges::find(potentials_by_name, *name, &KnownPotential::name);
  // Lennard-Jones, which LAMMPS is not asked for, has parameters.
  if (known == potentials_by_name.end() || !known->lammps) return std::nullopt;
  return PotentialChoice{.name = *name};
}

}  // namespace trivalent::shell
