#pragma once

#include <cstddef>
#include <memory>

namespace trivalent::potentials::rebo_detail {

/// An array that takes no memory before it is written to: large parts of some are never used.
template <typename T>
using PlainArray = std::unique_ptr<T[]>;

template <typename T>
[[nodiscard]] PlainArray<T> without_values(std::size_t count) {
  return PlainArray<T>(new T[count]);  // make_unique would write to all of it
}

}  // namespace trivalent::potentials::rebo_detail
