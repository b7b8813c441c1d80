#pragma once

#include <array>
#include <string_view>

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// What files say about an element.
struct SpeciesData {
  potentials::Species species;
  std::string_view symbol;
  double mass;  ///< standard atomic weight [u]
};

inline constexpr std::array known_species = {
    SpeciesData{potentials::Species::carbon, "C", 12.011},
    SpeciesData{potentials::Species::hydrogen, "H", 1.008},
};

}  // namespace trivalent::dual
