#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "arrays.h"
#include "atoms.h"
#include "errors.h"
#include "module.h"
#include "options.h"
#include "trivalent/dual/structure.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/shell/option_names.h"
#include "trivalent/shell/structure_source.h"

namespace trivalent::python {
namespace {

using dual::Structure;

const Structure& structure_in(const py::object& self) { return self.cast<const Structure&>(); }

py::array numbers_of(const Structure& structure) {
  const auto& species = structure.atoms.species;
  py::array_t<int> numbers(static_cast<py::ssize_t>(species.size()));
  std::ranges::transform(species, numbers.mutable_data(), [](potentials::Species each) {
    return each == potentials::Species::carbon ? 6 : 1;
  });
  return numbers;
}

/// Pairs of atoms, which stand in the memory of the bonds.
py::array bonds_of(const py::object& self) {
  const auto& bonds = structure_in(self).bonds;
  static_assert(offsetof(potentials::Bond, second) == sizeof(std::uint32_t));
  return view(bonds.empty() ? nullptr : &bonds[0].first,
              {static_cast<py::ssize_t>(bonds.size()), 2},
              {sizeof(potentials::Bond), sizeof(std::uint32_t)}, self);
}

py::array images_of(const py::object& self) {
  const auto& bonds = structure_in(self).bonds;
  return view(bonds.empty() ? nullptr : bonds[0].image.data(),
              {static_cast<py::ssize_t>(bonds.size()), 3},
              {sizeof(potentials::Bond), sizeof(std::int32_t)}, self);
}

py::list rings_of(const py::object& self) {
  py::list list;
  for (const dual::Ring& ring : structure_in(self).rings) list.append(view_of(ring.atoms, self));
  return list;
}

py::array column_view(const dual::Column& column, const py::object& self) {
  return std::visit(
      [&](const auto& values) -> py::array {
        using Value = typename std::remove_cvref_t<decltype(values)>::value_type;
        if constexpr (std::is_arithmetic_v<Value>) {
          return view_of(values, self);
        } else {
          return view_of_rows(values, self);
        }
      },
      column.values);
}

py::dict columns_of(const py::object& self) {
  py::dict columns;
  for (const dual::Column& column : structure_in(self).columns) {
    columns[py::str(column.name)] = column_view(column, self);
  }
  return columns;
}

py::dict header_of(const Structure& structure) {
  py::dict header;
  for (const dual::HeaderEntry& entry : structure.header) {
    header[py::str(entry.key)] =
        std::visit([](const auto& value) -> py::object { return py::cast(value); }, entry.value);
  }
  return header;
}

std::vector<potentials::Bond> bonds_from(py::handle pairs, const potentials::Atoms& atoms) {
  if (pairs.is_none()) return {};
  const IndexRows rows = index_rows(pairs, "bonds", static_cast<std::int64_t>(atoms.size()));
  if (rows.size() > 0 && rows.shape(1) != 2) throw InvalidArray("bonds: a bond is two atoms");
  std::vector<std::array<int, 2>> list(static_cast<std::size_t>(rows.size()) / 2);
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i] = {static_cast<int>(rows.data()[2 * i]), static_cast<int>(rows.data()[2 * i + 1])};
  }
  return potentials::bonds_between(atoms, list);
}

std::shared_ptr<Structure> make_structure(const py::handle& positions, const py::handle& numbers,
                                          const potentials::Box& box, const py::handle& bonds) {
  auto structure = std::make_shared<Structure>();
  const ArrayAtoms arrays(finite_rows(positions, "positions", 3), numbers, box);
  const potentials::AtomsView atoms = arrays.view();
  structure->atoms = {.positions = {atoms.positions.begin(), atoms.positions.end()},
                      .species = {atoms.species.begin(), atoms.species.end()},
                      .box = box};
  structure->bonds = bonds_from(bonds, structure->atoms);
  return structure;
}

/// @throws InvalidArray if they are not one per atom, or neither numbers nor rows of three.
dual::Column column_of(const std::string& name, const py::array& values, std::size_t n_atoms) {
  if (values.ndim() == 0 || values.shape(0) != static_cast<py::ssize_t>(n_atoms)) {
    throw InvalidArray(dual::concat(name, ": there must be one value per atom"));
  }
  const char kind = values.dtype().kind();
  if (values.ndim() == 2) {
    return {.name = name, .values = vectors(values, name)};
  }
  if (kind == 'i' || kind == 'u') {
    const IndexRows rows = integers(values, name);
    return {.name = name, .values = std::vector<int>(rows.data(), rows.data() + rows.size())};
  }
  const RealRows rows = finite_rows(values.attr("reshape")(-1, 1), name, 1);
  return {.name = name, .values = std::vector<double>(rows.data(), rows.data() + rows.size())};
}

/// A copy with other columns.
std::shared_ptr<Structure> with_columns(const Structure& structure, const py::dict& columns) {
  auto result = std::make_shared<Structure>(structure);
  result->columns.clear();
  for (const auto& [name, values] : columns) {
    const py::array array = py::array::ensure(values);
    if (!array) throw InvalidArray("columns: arrays are needed");
    result->columns.push_back(column_of(name.cast<std::string>(), array, structure.atoms.size()));
  }
  return result;
}

std::vector<potentials::Species> elements_of(const std::vector<std::string>& symbols) {
  std::vector<potentials::Species> elements;
  for (const std::string& symbol : symbols) {
    const auto element = dual::element_of_symbol(symbol);
    if (!element) throw WrongOption("elements are C and H, not '" + symbol + "'");
    elements.push_back(*element);
  }
  return elements;
}

dual::ReadOptions read_options(const Options& given) {
  dual::ReadOptions options = {.frame = given.find<int>("frame")};
  if (const auto symbols = given.find<std::vector<std::string>>("elements")) {
    options.elements = elements_of(*symbols);
  }
  if (given.has("atom_style")) {
    given.set("atom_style", options.atom_style.emplace(), shell::read_style_names);
  }
  return options;
}

/// The structure in a file, and what was left out or assumed.
py::tuple read(const std::filesystem::path& path, const py::dict& values) {
  const Options given(values);
  const shell::StructureOptions options = {.size = dual_size(given),
                                           .periodic = given.find<std::array<bool, 3>>("periodic"),
                                           .format = given.find<std::string>("format"),
                                           .reading = read_options(given)};
  dual::StructureFile file;
  {
    const py::gil_scoped_release released;
    file = shell::read_structure(path, options);
  }
  return py::make_tuple(std::make_shared<Structure>(std::move(file.structure)), file.notes);
}

/// @return  What the format changes.
std::vector<std::string> write(const Structure& structure, const std::filesystem::path& path,
                               const py::dict& values) {
  const Options given(values);
  dual::WriteOptions options;
  given.set("digits", options.digits, shell::digits_names);
  given.set("atom_style", options.atom_style, shell::atom_style_names);
  const dual::StructureFormat* format = dual::find_structure_format(path);
  if (format == nullptr || format->write == nullptr) {
    std::string known;
    for (const std::string& extension : dual::structure_extensions()) known += ' ' + extension;
    throw WrongOption("cannot write '" + path.string() + "': its extension must be one of" + known);
  }
  const py::gil_scoped_release released;
  return dual::write_structure(path, structure, options);
}

}  // namespace

void add_structure(py::module_& module) {
  py::class_<Structure, std::shared_ptr<Structure>>(module, "Structure",
                                                    "Atoms and all that is known of them")
      .def(py::init([](const py::object& positions, const py::object& numbers,
                       const py::object& cell, const std::array<bool, 3>& periodic,
                       const py::object& bonds) {
             return make_structure(positions, numbers, box_of(cell, periodic), bonds);
           }),
           py::arg("positions"), py::arg("numbers"), py::arg("cell"), py::arg("periodic"),
           py::arg("bonds"))
      .def_property_readonly(
          "positions",
          [](const py::object& self) {
            return view_of_rows(structure_in(self).atoms.positions, self);
          },
          "[Å], shape (n, 3)")
      .def_property_readonly("numbers", &numbers_of, "Atomic numbers, shape (n,)")
      .def_property_readonly(
          "cell",
          [](const py::object& self) {
            return view(structure_in(self).atoms.box.cell.data(), {3, 3},
                        {3 * sizeof(double), sizeof(double)}, self);
          },
          "Cell vectors as rows [Å], shape (3, 3); zero without a cell")
      .def_property_readonly(
          "origin",
          [](const py::object& self) {
            return view(structure_in(self).atoms.box.origin.data(), {3}, {sizeof(double)}, self);
          },
          "Lower corner of the cell [Å], shape (3,)")
      .def_property_readonly(
          "pbc", [](const Structure& structure) { return structure.atoms.box.periodic; },
          "Which cell vectors are periodic")
      .def_property_readonly("bonds", &bonds_of, "Pairs of atoms, shape (m, 2)")
      .def_property_readonly("bond_images", &images_of,
                             "Cell vectors to the second atom of each bond, shape (m, 3)")
      .def_property_readonly("rings", &rings_of, "Atoms in order around each ring")
      .def_property_readonly("columns", &columns_of, "Values per atom, by name")
      .def_property_readonly("header", &header_of, "Values of the whole, by name")
      .def("with_columns", &with_columns, py::arg("columns"), "A copy with other columns");
  module.def("read", &read, py::arg("path"), py::arg("options"), "Structure and notes of a file");
  module.def("write", &write, py::arg("structure"), py::arg("path"), py::arg("options"));
}

}  // namespace trivalent::python
