#pragma once

#include <pybind11/pybind11.h>

#include "trivalent/potentials/atoms.h"

namespace trivalent::python {

/// Atoms out of arrays: positions (n, 3) [Å], atomic numbers (n,), cell vectors as rows (3, 3) [Å],
/// and three bools. The memory of `atoms` is reused.
///
/// @throws InvalidArray if shapes or types differ from that, or an element is neither C nor H.
void set_atoms(potentials::Atoms& atoms, pybind11::handle positions, pybind11::handle numbers,
               const potentials::Box& box);

/// @param cell  (3, 3) [Å], or None for no box
[[nodiscard]] potentials::Box box_of(pybind11::handle cell, const std::array<bool, 3>& periodic);

}  // namespace trivalent::python
