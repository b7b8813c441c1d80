#pragma once

#include <string>

namespace trivalent::shell {

// Numbers as people read them: fixed decimals, a percentage, or a few significant digits.
[[nodiscard]] std::string decimals(double value, int n_decimals);
[[nodiscard]] std::string percent(double fraction);
[[nodiscard]] std::string significant(double value, int n_digits = 4);
/// In MB, or GB from 1 GB on.
[[nodiscard]] std::string bytes_text(double bytes);

}  // namespace trivalent::shell
