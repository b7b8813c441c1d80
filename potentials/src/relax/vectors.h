#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "parallel.h"

// Operations on long vectors, by all threads and with the same bytes on any number of them.
namespace trivalent::potentials::relax_detail {

using Vector = Eigen::VectorXd;

[[nodiscard]] inline double dot(const Vector& a, const Vector& b) {
  return sum_over_chunks<double>(static_cast<std::size_t>(a.size()), [&](auto begin, auto end) {
    const auto first = static_cast<Eigen::Index>(begin);
    const auto count = static_cast<Eigen::Index>(end - begin);
    return a.segment(first, count).dot(b.segment(first, count));
  });
}

/// y += factor · x.
inline void add_multiple(Vector& y, double factor, const Vector& x) {
  for_each_chunk(static_cast<std::size_t>(y.size()), [&](auto begin, auto end) {
    const auto first = static_cast<Eigen::Index>(begin);
    const auto count = static_cast<Eigen::Index>(end - begin);
    y.segment(first, count) += factor * x.segment(first, count);
  });
}

/// Largest norm of the consecutive triples of a vector.
[[nodiscard]] inline double largest_triple(const Vector& a) {
  struct Largest {
    double square = 0.0;
    Largest& operator+=(const Largest& other) {
      square = std::max(square, other.square);
      return *this;
    }
  };
  const auto n = static_cast<std::size_t>(a.size()) / 3;
  const auto of_chunk = [&](std::size_t begin, std::size_t end) {
    Largest largest;
    for (std::size_t i = begin; i < end; ++i) {
      const double square = a.segment<3>(static_cast<Eigen::Index>(3 * i)).squaredNorm();
      largest += Largest{square};
    }
    return largest;
  };
  return std::sqrt(sum_over_chunks<Largest>(n, of_chunk).square);
}

}  // namespace trivalent::potentials::relax_detail
