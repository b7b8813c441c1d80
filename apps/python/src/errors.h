#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>

namespace trivalent::python {

/// An array that has the wrong shape, type or values.
struct InvalidArray : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An option that has the wrong type, or does not go with the others.
struct WrongOption : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From here on the libraries' errors are those of trivalent._errors in Python.
void translate_errors();

}  // namespace trivalent::python
