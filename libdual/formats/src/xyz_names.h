#pragma once

#include <algorithm>
#include <cctype>
#include <string_view>

namespace trivalent::dual {

/// Whether a column or key of extended XYZ may be called so, by the rules of Column and
/// HeaderEntry.
[[nodiscard]] inline bool is_xyz_name(std::string_view name) {
  const auto is_allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_allowed);
}

}  // namespace trivalent::dual
