#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace trivalent::remesh {

/// Points sorted into the cells of a hashed grid, to find those near a place.
class PointGrid {
 public:
  /// @param points  Kept by reference.
  /// @param chosen  Numbers of the points to be found.
  /// @param cell    Edge of a cell, > 0, in the points' unit.
  PointGrid(std::span<const Eigen::Vector3d> points, std::span<const int> chosen, double cell);

  /// Calls visit(number, squared distance) for every point within the radius, in a fixed order.
  template <typename Visit>
  void visit(const Eigen::Vector3d& center, double radius, const Visit& visit) const {
    const Cell low = cell_of(center - Eigen::Vector3d::Constant(radius));
    const Cell high = cell_of(center + Eigen::Vector3d::Constant(radius));
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          visit_cell({x, y, z}, center, radius * radius, visit);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    std::uint64_t key;
    int number;
    Eigen::Vector3d position;
  };

  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& p) const {
    Cell cell{};
    for (int k = 0; k < 3; ++k) {
      cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(p[k] / size_));
    }
    return cell;
  }
  /// Different for cells less than two million apart.
  [[nodiscard]] static std::uint64_t key_of(const Cell& cell) {
    constexpr std::uint64_t bits = (1U << 21U) - 1U;
    return (static_cast<std::uint64_t>(cell[0]) & bits) << 42U |
           (static_cast<std::uint64_t>(cell[1]) & bits) << 21U |
           (static_cast<std::uint64_t>(cell[2]) & bits);
  }
  [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
  }
  template <typename Visit>
  void visit_cell(const Cell& cell, const Eigen::Vector3d& center, double squared_radius,
                  const Visit& visit) const {
    const std::uint64_t key = key_of(cell);
    const std::size_t bucket = bucket_of(key);
    for (std::size_t i = begin_[bucket]; i < begin_[bucket + 1]; ++i) {
      const Entry& entry = entries_[i];
      if (entry.key != key) continue;
      const double squared = (entry.position - center).squaredNorm();
      if (squared <= squared_radius) visit(entry.number, squared);
    }
  }

  double size_;
  unsigned shift_;
  std::vector<std::size_t> begin_;  // of each bucket in `entries_`, and the end of the last
  std::vector<Entry> entries_;
};

}  // namespace trivalent::remesh
