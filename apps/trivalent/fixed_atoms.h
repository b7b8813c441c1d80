#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::apps {

/// What --fix can name, for --help.
inline constexpr const char* fix_meaning =
    "atoms that stay: edge (fewer than three bonds), ids:1-9,12, sphere:x,y,z,radius or "
    "box:x0,y0,z0,x1,y1,z1 [Å]; may be given again";

/// The atoms that any of the groups holds, in ascending order.
///
/// @throws UsageError if a group makes no sense or names an atom that does not exist.
[[nodiscard]] std::vector<std::uint32_t> atoms_in_groups(
    const std::vector<std::string>& groups, const potentials::Atoms& atoms,
    const std::vector<potentials::Bond>& bonds);

}  // namespace trivalent::apps
