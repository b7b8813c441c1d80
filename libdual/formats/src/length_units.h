#pragma once

namespace trivalent::dual {

/// Bohr's radius [Å], CODATA 2018.
inline constexpr double bohr = 0.529177210903;

}  // namespace trivalent::dual
