#pragma once

#include <cstddef>
#include <span>

namespace trivalent::potentials::rebo_detail {

/// Asks for an array in good time.
template <typename T>
void prefetch(std::span<const T> array) {
  constexpr std::size_t cache_line = 64;
  const char* bytes = reinterpret_cast<const char*>(array.data());
  for (std::size_t k = 0; k < array.size_bytes(); k += cache_line) __builtin_prefetch(bytes + k);
}

/// One of several parts of about the same size.
struct Part {
  std::size_t number;
  std::size_t count;

  template <typename T>
  [[nodiscard]] std::span<T> of(std::span<T> whole) const {
    const std::size_t begin = whole.size() * number / count;
    return whole.subspan(begin, whole.size() * (number + 1) / count - begin);
  }
};

}  // namespace trivalent::potentials::rebo_detail
