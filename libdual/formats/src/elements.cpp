#include "trivalent/formats/elements.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "species_data.h"

namespace trivalent::dual {
namespace {

// Hydrogen to lawrencium, without the two that are known.
constexpr std::string_view other_symbols =
    " He Li Be B N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr"
    " Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er"
    " Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm"
    " Md No Lr ";

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::optional<potentials::Species> element_of_symbol(std::string_view symbol) {
  for (const SpeciesData& known : known_species) {
    if (lower_case(symbol) == lower_case(known.symbol)) return known.species;
  }
  return std::nullopt;
}

std::optional<potentials::Species> element_of_number(std::string_view number) {
  if (number == "6") return potentials::Species::carbon;
  if (number == "1") return potentials::Species::hydrogen;
  return std::nullopt;
}

std::optional<potentials::Species> element_of_mass(double mass) {
  for (const SpeciesData& known : known_species) {
    if (std::abs(mass - known.mass) < 0.5) return known.species;
  }
  return std::nullopt;
}

bool is_element_symbol(std::string_view word) {
  if (word.empty() || word.size() > 2) return false;
  const bool is_known = std::ranges::any_of(
      known_species, [&](const SpeciesData& known) { return known.symbol == word; });
  return is_known || other_symbols.find(" " + std::string(word) + " ") != std::string_view::npos;
}

std::string_view symbol_of(potentials::Species species) {
  return std::ranges::find(known_species, species, &SpeciesData::species)->symbol;
}

}  // namespace trivalent::dual
