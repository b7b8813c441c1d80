#pragma once

#include <pybind11/pybind11.h>

#include "arrays.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::python {

/// Atoms whose positions stay in the memory of a numpy array, which this keeps alive.
class ArrayAtoms {
 public:
  /// @param positions  (n, 3) [Å]; copied only if they are not contiguous doubles. Potentials see
  ///   for themselves whether they are finite.
  /// @param numbers    atomic numbers, (n,)
  /// @throws InvalidArray if shapes or types differ from that, or an element is neither C nor H.
  ArrayAtoms(pybind11::handle positions, pybind11::handle numbers, const potentials::Box& box);

  [[nodiscard]] potentials::AtomsView view() const;

 private:
  RealRows positions_;
  std::vector<potentials::Species> species_;
  potentials::Box box_;
};

/// @param cell  (3, 3) [Å], or None for no box
[[nodiscard]] potentials::Box box_of(pybind11::handle cell, const std::array<bool, 3>& periodic);

}  // namespace trivalent::python
