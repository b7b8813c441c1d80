#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace trivalent::shell {

/// A value of an enum and its name, as options, tables and JSON spell it.
template <typename Value>
struct Named {
  std::string_view name;
  Value value;
};

/// All values of an enum with their names, in the order in which people list them.
template <typename Value, std::size_t n>
using Names = std::array<Named<Value>, n>;

/// The name of a value; empty if the table lacks it.
template <typename Value, std::size_t n>
[[nodiscard]] constexpr std::string_view name_of(Value value, const Names<Value, n>& names) {
  for (const Named<Value>& each : names) {
    if (each.value == value) return each.name;
  }
  return {};
}

/// The value with this name, if there is one.
template <typename Value, std::size_t n>
[[nodiscard]] constexpr std::optional<Value> value_named(std::string_view name,
                                                         const Names<Value, n>& names) {
  for (const Named<Value>& each : names) {
    if (each.name == name) return each.value;
  }
  return std::nullopt;
}

/// As in "none, safe or wrap".
template <typename Value, std::size_t n>
[[nodiscard]] std::string list_of(const Names<Value, n>& names) {
  std::string list;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) list += i + 1 == n ? " or " : ", ";
    list += names[i].name;
  }
  return list;
}

}  // namespace trivalent::shell
