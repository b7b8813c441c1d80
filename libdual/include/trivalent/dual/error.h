#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace trivalent::dual {

/// Base of everything this library throws on purpose.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The network or mesh does not meet the function's requirements; the message names the element.
struct InvalidNetwork : Error {
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

}  // namespace trivalent::dual
