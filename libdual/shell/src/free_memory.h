#pragma once

#include <optional>

namespace trivalent::shell {

/// Memory [bytes] that this process may still take: what the machine has free, its control group
/// and its own limit (ulimit -v) allow. None where nobody tells.
[[nodiscard]] std::optional<double> free_memory();

}  // namespace trivalent::shell
