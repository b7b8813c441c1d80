#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace trivalent::remesh {

/// Points without repetitions.
struct NumberedPositions {
  std::vector<Eigen::Vector3d> positions;  ///< in the order of their first points
  std::vector<int> number_of;              ///< one entry per point: where in positions it is
};

/// Points are the same where all coordinates are equal; -0.0 equals 0.0. Cost: O(n).
[[nodiscard]] NumberedPositions number_positions(std::span<const Eigen::Vector3d> points);

/// Spreads every bit over the word, for tables: the multiplier of [Steele2014]'s SplitMix64.
[[nodiscard]] inline std::uint64_t spread_bits(std::uint64_t word) {
  word *= 0xbf58476d1ce4e5b9U;
  return word ^ (word >> 32);
}

}  // namespace trivalent::remesh
