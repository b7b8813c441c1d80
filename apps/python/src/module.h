#pragma once

#include <pybind11/pybind11.h>

namespace trivalent::python {

// What each file adds to the module.
void add_structure(pybind11::module_& module);
void add_surface(pybind11::module_& module);
void add_potentials(pybind11::module_& module);
void add_build(pybind11::module_& module);
void add_relax(pybind11::module_& module);
void add_views(pybind11::module_& module);

}  // namespace trivalent::python
