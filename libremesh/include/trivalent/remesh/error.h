#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace trivalent::remesh {

/// Base of everything this library throws on purpose.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The mesh does not meet the function's requirements; the message names the element.
struct InvalidMesh : Error {
  using Error::Error;
};

/// An option is out of its range.
struct InvalidOption : Error {
  using Error::Error;
};

/// A file is missing, unreadable, malformed, or cannot be written.
struct FileError : Error {
  using Error::Error;
};

/// The caller asked to stop before there was a result.
struct Stopped : Error {
  using Error::Error;
};

/// Joins the printed forms of all parts, for messages.
template <typename... Parts>
[[nodiscard]] std::string concat(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

}  // namespace trivalent::remesh
