#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// A note begins with this where bonds of a file cannot be right.
inline constexpr std::string_view unused_bonds = "the bonds of the file are not used: ";

/// What a file holds.
struct StructureFile {
  Structure structure = {};
  std::vector<std::string> notes = {};  ///< one sentence per kind of thing left out or assumed
};

}  // namespace trivalent::dual
