#include "trivalent/potentials/neighbor_list.h"

#include <cmath>
#include <tuple>

#include "cell_grid.h"
#include "parallel.h"
#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

[[nodiscard]] std::array<std::int32_t, 3> image_between(const GridPoint& from,
                                                        const GridPoint& to) {
  std::array<std::int32_t, 3> image{};
  for (std::size_t k = 0; k < 3; ++k) image[k] = to.image[k] - from.image[k];
  return image;
}

// Offsets of each atom's neighbors in one array, from their numbers.
[[nodiscard]] std::vector<std::size_t> first_neighbors(const CellGrid& grid, std::size_t atoms) {
  std::vector<std::size_t> first(atoms + 1, 0);
  for_each_chunk(grid.points().size(), [&](std::size_t begin, std::size_t end) {
    grid.for_each_neighbor(begin, end, [&](std::size_t p, std::size_t q, const auto&, double r2) {
      const std::uint32_t atom = grid.points()[p].atom;
      if (r2 <= 0.0) throw_coincident("neighbor list", atom, grid.points()[q].atom);
      ++first[atom + 1];
    });
  });
  for (std::size_t i = 0; i < atoms; ++i) first[i + 1] += first[i];
  return first;
}

}  // namespace

NeighborList::NeighborList(const Atoms& atoms, double cutoff) {
  require_valid(atoms, "neighbor list");
  require_positive(cutoff, "neighbor list", "cutoff");
  const CellGrid grid(atoms, cutoff);
  first_ = first_neighbors(grid, atoms.size());
  neighbors_.resize(first_.back());

  for_each_chunk(grid.points().size(), [&](std::size_t begin, std::size_t end) {
    std::size_t center = end;
    std::size_t next = 0;
    grid.for_each_neighbor(
        begin, end,
        [&](std::size_t p, std::size_t q, const Eigen::Vector3d& separation, double r2) {
          const GridPoint& from = grid.points()[p];
          const GridPoint& to = grid.points()[q];
          if (p != center) next = first_[from.atom];
          center = p;
          neighbors_[next++] = {to.atom, image_between(from, to), separation, std::sqrt(r2)};
        });
  });
  for_each_chunk(atoms.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::ranges::sort(std::span(neighbors_).subspan(first_[i], first_[i + 1] - first_[i]), {},
                        [](const Neighbor& n) { return std::tuple(n.atom, n.image); });
    }
  });
}

}  // namespace trivalent::potentials
