#include "atoms.h"

#include <algorithm>

#include "arrays.h"
#include "errors.h"
#include "trivalent/dual/error.h"

namespace trivalent::python {

using dual::concat;
using potentials::Species;

namespace {

Species species_of(std::int64_t atomic_number, std::size_t atom) {
  if (atomic_number == 6) return Species::carbon;
  if (atomic_number == 1) return Species::hydrogen;
  throw InvalidArray(concat("numbers: atom ", atom, " has the atomic number ", atomic_number,
                            "; only carbon (6) and hydrogen (1) are known"));
}

}  // namespace

potentials::Box box_of(py::handle cell, const std::array<bool, 3>& periodic) {
  potentials::Box box = {.periodic = periodic};
  if (cell.is_none()) {
    if (box.is_periodic()) throw InvalidArray("cell: periodic atoms need cell vectors");
    return box;
  }
  const RealRows rows = real_rows(cell, "cell", 3);
  if (rows.shape(0) != 3) throw InvalidArray("cell: three cell vectors are needed, one per row");
  // Its columns are the vectors, one after the other in memory, as rows are in numpy.
  std::copy(rows.data(), rows.data() + rows.size(), box.cell.data());
  return box;
}

void set_atoms(potentials::Atoms& atoms, py::handle positions, py::handle numbers,
               const potentials::Box& box) {
  const RealRows rows = real_rows(positions, "positions", 3);
  const IndexRows elements = integers(numbers, "numbers");
  const auto n = static_cast<std::size_t>(rows.shape(0));
  if (rows.shape(0) != elements.shape(0)) {
    throw InvalidArray(concat("numbers: ", elements.shape(0), " atomic numbers for ", n,
                              " positions; there must be one per atom"));
  }
  atoms.positions.resize(n);
  atoms.species.resize(n);
  if (n > 0) std::copy(rows.data(), rows.data() + rows.size(), atoms.positions[0].data());
  for (std::size_t i = 0; i < n; ++i) atoms.species[i] = species_of(elements.data()[i], i);
  atoms.box = box;
}

}  // namespace trivalent::python
