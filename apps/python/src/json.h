#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include "trivalent/shell/json.h"

namespace trivalent::python {

/// As reading the file would give it.
[[nodiscard]] inline pybind11::object to_python(const shell::Json& json) {
  return pybind11::module_::import("json").attr("loads")(shell::json_text(json));
}

}  // namespace trivalent::python
