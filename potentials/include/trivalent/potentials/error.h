#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace trivalent::potentials {

/// Base of everything this library throws on purpose.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Atoms that cannot be evaluated: not finite, on top of each other, missing box; names the atom.
struct InvalidAtoms : Error {
  using Error::Error;
};

/// An option is out of its range.
struct InvalidOption : Error {
  using Error::Error;
};

/// Joins the printed forms of all parts, for messages.
template <typename... Parts>
[[nodiscard]] std::string concat(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

}  // namespace trivalent::potentials
