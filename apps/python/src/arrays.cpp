#include "arrays.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "errors.h"
#include "trivalent/dual/error.h"

namespace trivalent::python {
namespace {

using dual::concat;

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    text += (axis > 0 ? ", " : "") + std::to_string(array.shape(axis));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// @param kinds  numpy's letters for the types that are welcome: i, u, f
py::array array_of(py::handle object, std::string_view name, std::string_view kinds) {
  py::array array = py::array::ensure(object);
  if (!array) throw InvalidArray(concat(name, ": not an array of numbers"));
  // An empty list is an array of doubles to numpy, whatever is meant.
  const char kind = array.dtype().kind();
  const bool is_empty_list = array.size() == 0 && kind == 'f';
  if (is_empty_list || kinds.find(kind) != std::string_view::npos) return array;
  throw InvalidArray(concat(name, ": the array holds ",
                            py::str(array.dtype().attr("name")).cast<std::string>(), ", not ",
                            kinds == "iu" ? "integers" : "real numbers"));
}

}  // namespace

RealRows real_rows(py::handle object, std::string_view name, py::ssize_t columns) {
  const py::array array = array_of(object, name, "iuf");
  if (array.ndim() != 2 || array.shape(1) != columns) {
    throw InvalidArray(
        concat(name, ": the shape must be (n, ", columns, "), not ", shape_text(array)));
  }
  RealRows rows = RealRows::ensure(array);
  if (!rows) throw InvalidArray(concat(name, ": too large, or not numbers"));
  return rows;
}

RealRows finite_rows(py::handle object, std::string_view name, py::ssize_t columns) {
  RealRows rows = real_rows(object, name, columns);
  const std::span values(rows.data(), static_cast<std::size_t>(rows.size()));
  const auto is_finite = [](double value) { return std::isfinite(value); };
  const auto bad = std::ranges::find_if_not(values, is_finite);
  if (bad == values.end()) return rows;
  throw InvalidArray(concat(name, ": row ", (bad - values.begin()) / columns, " is not finite"));
}

std::vector<Eigen::Vector3d> vectors(py::handle object, std::string_view name) {
  const RealRows rows = finite_rows(object, name, 3);
  std::vector<Eigen::Vector3d> result(static_cast<std::size_t>(rows.shape(0)));
  std::copy(rows.data(), rows.data() + rows.size(), result.empty() ? nullptr : result[0].data());
  return result;
}

IndexRows index_rows(py::handle object, std::string_view name, std::int64_t limit) {
  const py::array array = array_of(object, name, "iu");
  if (array.ndim() != 2) {
    throw InvalidArray(concat(name, ": the shape must be (n, m), not ", shape_text(array)));
  }
  IndexRows rows = IndexRows::ensure(array);
  if (!rows) throw InvalidArray(concat(name, ": too large, or not integers"));
  const std::int64_t* const end = rows.data() + rows.size();
  const std::int64_t* const bad =
      std::find_if(rows.data(), end, [&](std::int64_t i) { return i < 0 || i >= limit; });
  if (bad == end) return rows;
  throw InvalidArray(concat(name, ": row ", (bad - rows.data()) / rows.shape(1), " has the index ",
                            *bad, ", but indices go from 0 to ", limit - 1));
}

IndexRows integers(py::handle object, std::string_view name) {
  const py::array array = array_of(object, name, "iu");
  if (array.ndim() != 1) {
    throw InvalidArray(concat(name, ": the shape must be (n,), not ", shape_text(array)));
  }
  IndexRows numbers = IndexRows::ensure(array);
  if (!numbers) throw InvalidArray(concat(name, ": too large, or not integers"));
  return numbers;
}

}  // namespace trivalent::python
