#include "mesh/point_grid.h"

#include <algorithm>

namespace trivalent::remesh {

PointGrid::PointGrid(const TriMesh& mesh, double cell, double reach)
    : lattice_(mesh.lattice), size_(cell), shift_(63) {
  if (lattice_.is_periodic()) translations_ = lattice_.translations_within(reach);
  std::vector<Entry> unsorted;
  unsorted.reserve(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d p = lattice_.wrapped(mesh.point(v));
    unsorted.push_back({key_of(cell_of(p)), v.idx(), p});
    box_.extend(p);
  }
  while (shift_ > 40 && (std::size_t{1} << (64U - shift_)) < unsorted.size()) --shift_;
  // Counting sort: bucket k is [begin[k], begin[k + 1]).
  begin_.assign((std::size_t{1} << (64U - shift_)) + 1, 0);
  for (const Entry& entry : unsorted) ++begin_[bucket_of(entry.key) + 1];
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  entries_.resize(unsorted.size());
  for (const Entry& entry : unsorted) entries_[next[bucket_of(entry.key)]++] = entry;
}

}  // namespace trivalent::remesh
