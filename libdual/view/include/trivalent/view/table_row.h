#pragma once

#include <string>

namespace trivalent::dual {

/// A line of a table for people; without a value it is a heading.
struct TableRow {
  std::string name;
  std::string value = {};
};

}  // namespace trivalent::dual
