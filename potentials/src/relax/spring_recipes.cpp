#include "relax/spring_recipes.h"

#include <algorithm>
#include <cmath>

#include "rebo/parameters.h"

namespace trivalent::potentials::relax_detail {

namespace {

// Bounds of an sp2 bond without great strain [Å].
constexpr LengthRange sound_carbon_bond = {1.25, 1.65};

bool is_carbon_bond(const Atoms& atoms, const Bond& bond) {
  return atoms.species[bond.first] == Species::carbon &&
         atoms.species[bond.second] == Species::carbon;
}

std::vector<LengthRange> lengths_of(const Atoms& atoms, std::span<const Bond> bonds,
                                    const auto& length) {
  std::vector<LengthRange> lengths;
  lengths.reserve(bonds.size());
  for (const Bond& bond : bonds) {
    lengths.push_back(length(atoms.species[bond.first], atoms.species[bond.second], bond));
  }
  return lengths;
}

}  // namespace

double bond_at_rest(Species a, Species b) {
  if (a == Species::carbon && b == Species::carbon) return 1.42;
  return a == b ? 0.74 : 1.09;
}

double max_free_bond(Species a, Species b) {
  const auto [begin, end] = rebo_detail::brenner_2002.bond(a, b).cutoff;
  return begin + (end - begin) / 3.0;
}

bool is_rough(const Atoms& atoms, std::span<const Bond> bonds) {
  const bool has_unsound_bond = std::ranges::any_of(bonds, [&](const Bond& bond) {
    if (!is_carbon_bond(atoms, bond)) return false;
    const double length = bond_length(atoms, bond);
    return length < sound_carbon_bond.min || length > sound_carbon_bond.max;
  });
  return has_unsound_bond || !bond_changes(atoms, bonds).formed.empty();
}

Swelling::Swelling(const Atoms& atoms, std::span<const Bond> bonds) {
  double largest = 0.0;
  for (const Bond& bond : bonds) {
    at_rest_.push_back(bond_at_rest(atoms.species[bond.first], atoms.species[bond.second]));
    logarithms_.push_back(std::log(bond_length(atoms, bond) / at_rest_.back()));
    largest = std::max(largest, std::abs(logarithms_.back()));
  }
  // A part changes no bond by more than from 1.42 to 1.2 Å. At most 100 parts.
  constexpr double largest_part = 0.17;
  part_count_ = std::max(1, static_cast<int>(std::min(100.0, std::ceil(largest / largest_part))));
}

// Bonds half as stiff as an aromatic one (40 eV/Å²). On the raw dual of a scan (rocker-arm), these
// springs leave no bond outside 1.25 to 1.65 Å and no other pair within 2 Å.
SpringOptions Swelling::springs(int part, double smoothness) const {
  const double left = static_cast<double>(part_count_ - part) / part_count_;
  SpringOptions options = {.lengths = {},
                           .bond_stiffness = 20.0,
                           .smoothness = smoothness,
                           .contact = {.second = 2.2, .third = 2.5, .others = 3.0},
                           .contact_stiffness = 20.0};
  for (std::size_t k = 0; k < at_rest_.size(); ++k) {
    const double length = at_rest_[k] * std::exp(left * logarithms_[k]);
    options.lengths.push_back({length, length});
  }
  return options;
}

// Stiffer than an aromatic bond, so that the bounds hold; contacts just beyond its reach of 2 Å.
SpringOptions bounding_springs(const Atoms& atoms, std::span<const Bond> bonds) {
  return {.lengths = lengths_of(atoms, bonds,
                                [](Species a, Species b, const Bond&) -> LengthRange {
                                  const double rest = bond_at_rest(a, b);
                                  const bool is_carbon = a == Species::carbon && a == b;
                                  return is_carbon ? sound_carbon_bond : LengthRange{rest, rest};
                                }),
          .bond_stiffness = 100.0,
          .smoothness = 0.0,
          .contact = {.second = 2.05, .third = 2.3, .others = 2.6},
          .contact_stiffness = 100.0};
}

// Twice as stiff again: a bond that is held stretches little beyond the limit.
SpringOptions holding_springs(const Atoms& atoms, std::span<const Bond> bonds) {
  return {.lengths = lengths_of(atoms, bonds,
                                [](Species a, Species b, const Bond&) -> LengthRange {
                                  return {0.0, max_free_bond(a, b)};
                                }),
          .bond_stiffness = 200.0,
          .smoothness = 0.0,
          .contact = {},
          .contact_stiffness = 0.0};
}

}  // namespace trivalent::potentials::relax_detail
