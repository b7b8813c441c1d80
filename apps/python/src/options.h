#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <initializer_list>
#include <optional>
#include <string>

#include "errors.h"
#include "trivalent/dual/dual_size.h"
#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/shell/build_shell.h"
#include "trivalent/shell/names.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::python {

namespace py = pybind11;

/// Options by name, as functions in Python get them; None means that the library's default holds.
class Options {
 public:
  explicit Options(py::dict values) : values_(std::move(values)) {}

  [[nodiscard]] bool has(const char* name) const {
    return values_.contains(name) && !values_[name].is_none();
  }
  [[nodiscard]] bool is_text(const char* name) const {
    return has(name) && py::isinstance<py::str>(values_[name]);
  }
  /// @throws WrongOption if the option has another type.
  template <typename Value>
  [[nodiscard]] std::optional<Value> find(const char* name) const {
    if (!has(name)) return std::nullopt;
    try {
      return values_[name].cast<Value>();
    } catch (const py::cast_error&) {
      refuse_type(name);
    }
  }
  /// Leaves the value as it is if the option is not given.
  template <typename Value>
  void set(const char* name, Value& value) const {
    if (auto given = find<Value>(name)) value = std::move(*given);
  }
  /// The same for an option that takes a name out of a table.
  template <typename Value, std::size_t n>
  void set(const char* name, Value& value, const shell::Names<Value, n>& names) const {
    const auto given = find<std::string>(name);
    if (!given) return;
    const auto found = shell::value_named(*given, names);
    if (!found) {
      throw WrongOption(std::string(name) + " is " + shell::list_of(names) + ", not '" + *given +
                        "'");
    }
    value = *found;
  }
  /// @throws WrongOption if more than one of them is given.
  void allow_one(std::initializer_list<const char*> names) const;
  /// @throws WrongOption if one of them is given.
  void refuse(std::initializer_list<const char*> names, const std::string& reason) const;

 private:
  [[noreturn]] void refuse_type(const char* name) const;

  py::dict values_;
};

// What the functions of the module have in common; names and defaults are those of the program.
/// atoms, length or scale; bond, and the method of remesh_method().
[[nodiscard]] dual::ShellOptions shell_options(const Options& options);
/// length, scale or bond.
[[nodiscard]] std::optional<dual::DualSize> dual_size(const Options& options);
/// method, feature_angle [degree], and the method's own: effort, follow, seed, or iterations,
/// rings, sigma, restriction.
[[nodiscard]] remesh::RemeshMethod remesh_method(const Options& options);
/// repair, holes, components, wrap_alpha, wrap_offset.
[[nodiscard]] remesh::RepairOptions repair_options(const Options& options);
/// cell or box (a text as shell::parse_cell() takes it, or three rows of cell vectors), level,
/// pbc, raw, supercell.
[[nodiscard]] shell::CellOptions cell_options(const Options& options);
/// potential, and lj_epsilon, lj_sigma, lj_cutoff, lj_shift.
[[nodiscard]] shell::PotentialChoice potential_choice(const Options& options);

}  // namespace trivalent::python
