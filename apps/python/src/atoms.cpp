#include "atoms.h"

#include <algorithm>
#include <span>

#include "errors.h"
#include "trivalent/dual/error.h"

namespace trivalent::python {

using dual::concat;
using potentials::Species;

namespace {

std::vector<Species> species_of(std::span<const std::int64_t> numbers) {
  std::vector<Species> species(numbers.size());
  std::size_t n_known = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    species[i] = numbers[i] == 6 ? Species::carbon : Species::hydrogen;
    n_known += numbers[i] == 6 || numbers[i] == 1 ? 1 : 0;
  }
  if (n_known == numbers.size()) return species;
  const auto unknown =
      std::ranges::find_if(numbers, [](std::int64_t number) { return number != 6 && number != 1; });
  throw InvalidArray(concat("numbers: atom ", unknown - numbers.begin(), " has the atomic number ",
                            *unknown, "; only carbon (6) and hydrogen (1) are known"));
}

}  // namespace

potentials::Box box_of(py::handle cell, const std::array<bool, 3>& periodic) {
  potentials::Box box = {.periodic = periodic};
  if (cell.is_none()) {
    if (box.is_periodic()) throw InvalidArray("cell: periodic atoms need cell vectors");
    return box;
  }
  const RealRows rows = finite_rows(cell, "cell", 3);
  if (rows.shape(0) != 3) throw InvalidArray("cell: three cell vectors are needed, one per row");
  // Its columns are the vectors, one after the other in memory, as rows are in numpy.
  std::copy(rows.data(), rows.data() + rows.size(), box.cell.data());
  return box;
}

ArrayAtoms::ArrayAtoms(py::handle positions, py::handle numbers, const potentials::Box& box)
    : positions_(real_rows(positions, "positions", 3)), box_(box) {
  const IndexRows elements = integers(numbers, "numbers");
  if (positions_.shape(0) != elements.shape(0)) {
    throw InvalidArray(concat("numbers: ", elements.shape(0), " atomic numbers for ",
                              positions_.shape(0), " positions; there must be one per atom"));
  }
  species_ = species_of({elements.data(), static_cast<std::size_t>(elements.size())});
}

potentials::AtomsView ArrayAtoms::view() const {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const auto* first = reinterpret_cast<const Eigen::Vector3d*>(positions_.data());
  return {{first, species_.size()}, species_, box_};
}

}  // namespace trivalent::python
