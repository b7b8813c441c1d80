#pragma once

#include <cstddef>
#include <string>

namespace trivalent::shell {

// Numbers as people read them: fixed decimals, a percentage, or a few significant digits.
[[nodiscard]] std::string decimals(double value, int n_decimals);
[[nodiscard]] std::string percent(double fraction);
[[nodiscard]] std::string significant(double value, int n_digits = 4);
/// In MB, or GB from 1 GB on.
[[nodiscard]] std::string bytes_text(double bytes);

/// The first few of a list, separated by commas; "..." at the end says that there are more.
///
/// @param text_of  The text of one.
template <typename List, typename TextOf>
[[nodiscard]] std::string first_of(const List& list, std::size_t max_listed,
                                   const TextOf& text_of) {
  std::string text;
  for (std::size_t k = 0; k < list.size() && k < max_listed; ++k) {
    text += (k > 0 ? ", " : "") + text_of(list[k]);
  }
  return text + (list.size() > max_listed ? ", ..." : "");
}

}  // namespace trivalent::shell
