#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trivalent::potentials {

// Work is cut into chunks of a fixed size, whatever the number of threads, and partial sums are
// added in the order of the chunks: results are the same bytes on any number of threads.
constexpr std::size_t chunk_size = 1024;

[[nodiscard]] constexpr std::size_t chunk_count(std::size_t n) {
  return (n + chunk_size - 1) / chunk_size;
}

/// Calls body(part) for all parts of [0, count), in parallel.
template <typename Body>
void for_each_part(std::size_t count, const Body& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
}

/// Sum of body(part) over [0, count) in that order; Sum needs a default constructor and +=.
template <typename Sum, typename Body>
[[nodiscard]] Sum sum_over_parts(std::size_t count, const Body& body) {
  std::vector<Sum> parts(count);
  for_each_part(count, [&](std::size_t part) { parts[part] = body(part); });
  Sum sum{};
  for (const Sum& part : parts) sum += part;
  return sum;
}

/// Calls body(begin, end) for all chunks of [0, n), in parallel.
template <typename Body>
void for_each_chunk(std::size_t n, const Body& body) {
  for_each_part(chunk_count(n), [&](std::size_t chunk) {
    body(chunk * chunk_size, std::min(n, (chunk + 1) * chunk_size));
  });
}

/// Sum of body(begin, end) over all chunks of [0, n).
template <typename Sum, typename Body>
[[nodiscard]] Sum sum_over_chunks(std::size_t n, const Body& body) {
  return sum_over_parts<Sum>(chunk_count(n), [&](std::size_t chunk) {
    return body(chunk * chunk_size, std::min(n, (chunk + 1) * chunk_size));
  });
}

}  // namespace trivalent::potentials
