#include "crystal/point_grid.h"

#include <algorithm>

namespace trivalent::remesh {

PointGrid::PointGrid(std::span<const Eigen::Vector3d> points, std::span<const int> chosen,
                     double cell)
    : size_(cell), shift_(63) {
  while (shift_ > 40 && (std::size_t{1} << (64U - shift_)) < chosen.size()) --shift_;
  std::vector<Entry> unsorted;
  unsorted.reserve(chosen.size());
  for (const int i : chosen) {
    const Eigen::Vector3d& p = points[static_cast<std::size_t>(i)];
    unsorted.push_back({key_of(cell_of(p)), i, p});
  }
  // Counting sort: bucket k is [begin[k], begin[k + 1]).
  begin_.assign((std::size_t{1} << (64U - shift_)) + 1, 0);
  for (const Entry& entry : unsorted) ++begin_[bucket_of(entry.key) + 1];
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  entries_.resize(unsorted.size());
  for (const Entry& entry : unsorted) entries_[next[bucket_of(entry.key)]++] = entry;
}

}  // namespace trivalent::remesh
