#include "trivalent/potentials/neighbor_list.h"

#include <cmath>
#include <tuple>

#include "cell_grid.h"
#include "parallel.h"
#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

// Calls visit(from, to, separation, squared_distance) for all neighbors, from both ends of each
// pair.
template <typename Visit>
void for_each_pair(const AtomsView& atoms, double cutoff, const CellGrid& grid,
                   const Visit& visit) {
  for_each_chunk(grid.points().size(), [&](std::size_t begin, std::size_t end) {
    grid.for_each_neighbor(
        begin, end,
        [&](std::size_t p, std::size_t q, const Eigen::Vector3d& separation, double r2) {
          const GridPoint& from = grid.points()[p];
          const GridPoint& to = grid.points()[q];
          if (is_nearer(atoms, from, to, {r2, cutoff * cutoff})) visit(from, to, separation, r2);
        });
  });
}

}  // namespace

NeighborList::NeighborList(const AtomsView& atoms, double cutoff) {
  require_valid(atoms, "neighbor list");
  require_positive(cutoff, "neighbor list", "cutoff");
  const CellGrid grid(atoms, cutoff * rounding_margin);
  first_.assign(atoms.size() + 1, 0);
  for_each_pair(atoms, cutoff, grid,
                [&](const GridPoint& from, const GridPoint& to, const auto&, double r2) {
                  if (r2 <= 0.0) throw_coincident("neighbor list", from.atom, to.atom);
                  ++first_[from.atom + 1];
                });
  for (std::size_t i = 0; i < atoms.size(); ++i) first_[i + 1] += first_[i];
  neighbors_.resize(first_.back());

  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for_each_pair(atoms, cutoff, grid,
                [&](const GridPoint& from, const GridPoint& to, const auto& separation, double r2) {
                  neighbors_[next[from.atom]++] = {to.atom, image_between(from, to), separation,
                                                   std::sqrt(r2)};
                });
  for_each_chunk(atoms.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::ranges::sort(std::span(neighbors_).subspan(first_[i], first_[i + 1] - first_[i]), {},
                        [](const Neighbor& n) { return std::tuple(n.atom, n.image); });
    }
  });
}

}  // namespace trivalent::potentials
