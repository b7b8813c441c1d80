#pragma once

#include <array>
#include <string>
#include <vector>

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// Bonds as pairs of atoms [from 0], each once, for formats that know no periodic images. Two bonds
/// of the same atoms become one, and a bond of an atom to its own image is left out; both are
/// noted.
[[nodiscard]] std::vector<std::array<int, 2>> bond_pairs(const Structure& structure,
                                                         std::vector<std::string>& notes);

}  // namespace trivalent::dual
