#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// The vertices of a mesh sorted into the cells of a hashed grid, to find those near a place.
class PointGrid {
 public:
  /// @param cell    Edge of a cell of the grid, > 0, in the mesh's unit.
  /// @param reach   Maximum radius of a visit.
  PointGrid(const TriMesh& mesh, double cell, double reach);

  /// Calls visit(vertex, separation from the center) for every vertex within the radius, in a fixed
  /// order; in a lattice for every image.
  template <typename Visit>
  void visit(const Eigen::Vector3d& center, double radius, const Visit& visit) const {
    const Eigen::Vector3d home = lattice_.wrapped(center);
    visit_box(home, radius, visit);
    for (const Eigen::Vector3d& translation : translations_) {
      const Eigen::Vector3d image = home + translation;
      if (box_.squaredExteriorDistance(image) <= radius * radius) visit_box(image, radius, visit);
    }
  }

 private:
  template <typename Visit>
  void visit_box(const Eigen::Vector3d& center, double radius, const Visit& visit) const {
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

  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    std::uint64_t key;
    int vertex;
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
      const Eigen::Vector3d separation = entry.position - center;
      if (separation.squaredNorm() <= squared_radius) visit(entry.vertex, separation);
    }
  }

  Lattice lattice_;
  std::vector<Eigen::Vector3d> translations_;  // to images within reach
  Eigen::AlignedBox3d box_;                    // around all entries
  double size_;
  unsigned shift_;
  std::vector<std::size_t> begin_;  // of each bucket in `entries_`, and the end of the last
  std::vector<Entry> entries_;
};

}  // namespace trivalent::remesh
