#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::shell {

/// The atoms in any of the groups, ascending. A group is a text:
/// edge (atoms with fewer than three bonds), ids:1-9,12 (counted from 1), sphere:x,y,z,radius or
/// box:x0,y0,z0,x1,y1,z1 [Å].
///
/// @throws dual::InvalidOption if a group cannot be read, names an atom that does not exist, or
/// holds
///   no atom.
[[nodiscard]] std::vector<std::uint32_t> atoms_in_groups(
    const std::vector<std::string>& groups, const potentials::Atoms& atoms,
    const std::vector<potentials::Bond>& bonds);

}  // namespace trivalent::shell
