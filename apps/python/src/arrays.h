#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace trivalent::python {

namespace py = pybind11;

/// A read-only array that looks into the memory of `owner` and keeps it alive; no copy.
template <typename Value>
[[nodiscard]] py::array view(const Value* data, std::vector<py::ssize_t> shape,
                             std::vector<py::ssize_t> strides, py::handle owner) {
  py::array array(py::dtype::of<Value>(), std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(false);
  return array;
}

/// One number per row.
template <typename Value>
[[nodiscard]] py::array view_of(const std::vector<Value>& numbers, py::handle owner) {
  return view(numbers.data(), {static_cast<py::ssize_t>(numbers.size())}, {sizeof(Value)}, owner);
}

/// Rows of three numbers: std::array<int, 3> or Eigen::Vector3d.
template <typename Row>
[[nodiscard]] py::array view_of_rows(const std::vector<Row>& rows, py::handle owner) {
  using Value = std::remove_cvref_t<decltype(rows[0][0])>;
  return view(rows.empty() ? nullptr : rows[0].data(), {static_cast<py::ssize_t>(rows.size()), 3},
              {sizeof(Row), sizeof(Value)}, owner);
}

/// Numbers in rows and columns, of any real or integer type, aligned or not, in any order of bytes:
/// only what is not so already is copied.
///
/// @throws InvalidArray if it is no array of real numbers of shape (n, columns); the message begins
///   with the name.
using RealRows = py::array_t<double, py::array::c_style | py::array::forcecast |
                                         py::detail::npy_api::NPY_ARRAY_ALIGNED_>;
[[nodiscard]] RealRows real_rows(py::handle object, std::string_view name, py::ssize_t columns);

/// Likewise, of finite numbers.
[[nodiscard]] RealRows finite_rows(py::handle object, std::string_view name, py::ssize_t columns);

/// Three numbers in a row, as in positions [Å].
[[nodiscard]] std::vector<Eigen::Vector3d> vectors(py::handle object, std::string_view name);

/// Indices in rows.
///
/// @throws InvalidArray if it is no array of integers with two dimensions, or an index is negative
///   or not below the limit.
using IndexRows = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast |
                                                py::detail::npy_api::NPY_ARRAY_ALIGNED_>;
[[nodiscard]] IndexRows index_rows(py::handle object, std::string_view name, std::int64_t limit);

/// Integers, one per row.
///
/// @throws InvalidArray if it is no array of integers with one dimension.
[[nodiscard]] IndexRows integers(py::handle object, std::string_view name);

}  // namespace trivalent::python
