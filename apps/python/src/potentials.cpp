#include <pybind11/stl.h>

#include <cstring>
#include <memory>
#include <mutex>
#include <utility>

#include "atoms.h"
#include "module.h"
#include "trivalent/shell/potential_choice.h"

namespace trivalent::python {
namespace {

using potentials::EnergyForces;

/// A potential with the result of its last evaluation, so that its memory and the neighbors are
/// used again. Several threads may call it; they take turns.
class Calculator {
 public:
  explicit Calculator(const shell::PotentialChoice& choice)
      : potential_(shell::make_potential(choice)) {}

  std::shared_ptr<EnergyForces> evaluate(const py::handle& positions, const py::handle& numbers,
                                         const py::handle& cell,
                                         const std::array<bool, 3>& periodic) {
    const ArrayAtoms atoms(positions, numbers, box_of(cell, periodic));
    EnergyForces memory = take_memory();
    const py::gil_scoped_release released;
    const std::scoped_lock lock(evaluating_);
    last_result_ =
        std::make_shared<EnergyForces>(potential_->evaluate(atoms.view(), std::move(memory)));
    return last_result_;
  }

 private:
  /// The arrays of the last result, if Python has none of them; none while another thread
  /// evaluates.
  EnergyForces take_memory() {
    const std::unique_lock lock(evaluating_, std::try_to_lock);
    if (!lock || last_result_.use_count() != 1) return {};
    return std::move(*std::exchange(last_result_, nullptr));
  }

  std::mutex evaluating_;
  std::unique_ptr<potentials::Potential> potential_;
  std::shared_ptr<EnergyForces> last_result_;
};

/// Whether two arrays have the same type, shape and bytes; without the temporary array of numpy's
/// comparison, which costs as much as a twentieth of an evaluation.
bool are_same_bytes(const py::array& first, const py::array& second) {
  const bool are_alike = first.dtype().equal(second.dtype()) && first.ndim() == second.ndim() &&
                         std::equal(first.shape(), first.shape() + first.ndim(), second.shape());
  constexpr int contiguous = py::array::c_style;
  if (!are_alike || (first.flags() & second.flags() & contiguous) == 0) return false;
  return std::memcmp(first.data(), second.data(), static_cast<std::size_t>(first.nbytes())) == 0;
}

std::unique_ptr<Calculator> make_calculator(const std::string& name, double epsilon, double sigma,
                                            double cutoff, bool shift) {
  return std::make_unique<Calculator>(shell::PotentialChoice{
      .name = name,
      .lennard_jones = {.epsilon = epsilon, .sigma = sigma, .cutoff = cutoff, .shift = shift}});
}

}  // namespace

void add_potentials(py::module_& module) {
  py::class_<EnergyForces, std::shared_ptr<EnergyForces>>(module, "Evaluation",
                                                          "Energies, forces and virial")
      .def_readonly("energy", &EnergyForces::energy, "Total potential energy [eV]")
      .def_property_readonly(
          "energies",
          [](const py::object& self) {
            return view_of(self.cast<const EnergyForces&>().energies, self);
          },
          "Of the atoms [eV], shape (n,); they sum to the energy")
      .def_property_readonly(
          "forces",
          [](const py::object& self) {
            return view_of_rows(self.cast<const EnergyForces&>().forces, self);
          },
          "On the atoms [eV/Å], shape (n, 3)")
      .def_property_readonly(
          "virial",
          [](const py::object& self) {
            // Symmetric: rows and columns are the same.
            return view(self.cast<const EnergyForces&>().virial.data(), {3, 3},
                        {3 * sizeof(double), sizeof(double)}, self);
          },
          "-dE/dε for a strain ε [eV], shape (3, 3)");
  const potentials::LennardJonesOptions lj;
  py::class_<Calculator>(module, "Calculator", "A potential that keeps neighbors between calls")
      .def(py::init(&make_calculator), py::arg("name"), py::kw_only(),
           py::arg("epsilon") = lj.epsilon, py::arg("sigma") = lj.sigma,
           py::arg("cutoff") = lj.cutoff, py::arg("shift") = lj.shift,
           "name: rebo, airebo or lj; epsilon [eV], sigma and cutoff [Å] and shift are of lj")
      .def("evaluate", &Calculator::evaluate, py::arg("positions"), py::arg("numbers"),
           py::arg("cell"), py::arg("periodic"),
           "Energies, forces and virial of atoms: positions (n, 3) [Å], atomic numbers (n,), cell "
           "vectors as rows (3, 3) [Å] or None, and which of them are periodic");
  module.def("are_same_bytes", &are_same_bytes, py::arg("first"), py::arg("second"),
             "Whether two contiguous arrays have the same type, shape and bytes");
}

}  // namespace trivalent::python
