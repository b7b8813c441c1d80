#pragma once

#include <optional>
#include <string>

#include "trivalent/dual/shell_checks.h"

namespace trivalent::shell {

// Lengths and angles with the ids of their atoms.
[[nodiscard]] std::string pair_text(const std::optional<dual::AtomPair>& pair);
[[nodiscard]] std::string angle_text(const std::optional<dual::BondAngle>& angle);

}  // namespace trivalent::shell
