#pragma once

#include <stdexcept>

#include "trivalent/remesh/error.h"

namespace trivalent::dual {

/// Base of what only this library throws.
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

// One kind for the files of both libraries, since one function writes them all.
using remesh::FileError;

using remesh::concat;

}  // namespace trivalent::dual
