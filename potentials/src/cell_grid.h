#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials {

/// An atom, or a periodic image of one, as it takes part in a search for neighbors.
struct GridPoint {
  Eigen::Vector3d position;           ///< [Å]; position of the atom + cell · image
  std::uint32_t atom;                 ///< index into Atoms
  std::array<std::int16_t, 3> image;  ///< not always 0 at home: atoms outside the cell are wrapped
  bool is_home;                       ///< one point of each atom is; the others are its images
};

/// Cell vectors between two points, as counted from the positions of their atoms as given.
[[nodiscard]] std::array<std::int32_t, 3> image_between(const GridPoint& from, const GridPoint& to);

/// Squares of the distance between two points, as rounded, and of the one it is compared with [Å²].
struct Squared {
  double distance;
  double cutoff;
};

/// Two atoms, the second in a cell so many cell vectors away.
struct ImagePair {
  std::uint32_t first;
  std::uint32_t second;
  std::array<std::int32_t, 3> image;
};

/// Whether two atoms are nearer than a distance, with the same answer from both ends even where
/// the rounding of periodic images would decide.
[[nodiscard]] bool is_nearer(const AtomsView& atoms, ImagePair pair, Squared distances);
[[nodiscard]] bool is_nearer(const AtomsView& atoms, const GridPoint& from, const GridPoint& to,
                             Squared distances);

/// Two distances this close relative to each other may be swapped by rounding: a search whose
/// results are passed to is_nearer has a cutoff larger by this factor.
constexpr double rounding_margin = 1.0 + 1e-6;

/// All atoms, and the images of them that lie within the cutoff of an atom, sorted into cubic
/// cells.
///
/// Only occupied cells exist, as runs of the sorted points, so an empty box costs nothing. Cells
/// are ordered by rows: the three neighbors of a cell along x are one run of points, and the nine
/// runs around a cell only move forward from one cell to the next.
class CellGrid {
 public:
  /// @param atoms   valid ones, see require_valid.
  /// @param cutoff  [Å], > 0.
  /// @throws InvalidAtoms if there are more images than can be counted.
  CellGrid(const AtomsView& atoms, double cutoff);

  [[nodiscard]] std::span<const GridPoint> points() const { return points_; }

  /// Calls visit(center, other, separation, squared_distance) for each home point in [begin, end)
  /// and every other point nearer to it than the cutoff, in the order of the points.
  template <typename Visit>
  void for_each_neighbor(std::size_t begin, std::size_t end, const Visit& visit) const;

 private:
  using Key = std::uint64_t;

  struct Run {
    std::size_t begin;
    std::size_t end;
  };

  // Of the nine rows of cells around the cell of a key: what to add to the key to get there.
  static constexpr std::array<std::int64_t, 9> row_offsets = [] {
    std::array<std::int64_t, 9> offsets{};
    for (int k = 0; k < 9; ++k) {
      offsets[static_cast<std::size_t>(k)] =
          (k % 3 - 1) * (std::int64_t{1} << 21) + (k / 3 - 1) * (std::int64_t{1} << 42);
    }
    return offsets;
  }();

  void sort_into_cells();
  void move_forward(Key key, std::array<Run, 9>& runs) const;

  double squared_cutoff_;
  double cell_size_;
  std::vector<GridPoint> points_;  // sorted by key
  std::vector<Key> keys_;          // cell of each point: x + 2^21 y + 2^42 z, each in [1, 2^20 + 1]
};

template <typename Visit>
void CellGrid::for_each_neighbor(std::size_t begin, std::size_t end, const Visit& visit) const {
  std::array<Run, 9> runs{};
  for (std::size_t p = begin; p < end; ++p) {
    if (p == begin || keys_[p] != keys_[p - 1]) move_forward(keys_[p], runs);
    const GridPoint& center = points_[p];
    if (!center.is_home) continue;
    for (const Run run : runs) {
      for (std::size_t q = run.begin; q < run.end; ++q) {
        const Eigen::Vector3d separation = points_[q].position - center.position;
        const double squared_distance = separation.squaredNorm();
        if (squared_distance < squared_cutoff_ && q != p) {
          visit(p, q, separation, squared_distance);
        }
      }
    }
  }
}

}  // namespace trivalent::potentials
