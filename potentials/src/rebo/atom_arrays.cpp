#include "rebo/atom_arrays.h"

#include <algorithm>

#include "parallel.h"

namespace trivalent::potentials::rebo_detail {

AtomArrays::AtomArrays(const Candidates& candidates, const Box& box)
    : positions(without_values<double>(4 * candidates.point_count())),
      states(without_values<std::uint8_t>(candidates.count())),
      bonded(without_values<std::uint32_t>(candidates.count())),
      coordinations(without_values<Coordination>(candidates.count())),
      candidates_(candidates),
      box_(box) {
  std::fill_n(states.get(), candidates.count(), std::uint8_t{0});
  image_homes.reserve(candidates.images.size());
  for (const Candidates::Image& image : candidates.images) image_homes.push_back(image.home);
}

void AtomArrays::place_tile(const AtomsView& atoms, std::size_t tile) {
  const Candidates& c = candidates_;
  for (std::uint32_t i = c.tiles[tile]; i < c.tiles[tile + 1]; ++i) {
    Eigen::Vector3d x = atoms.positions[c.order[i]];
    if (!c.wraps.empty()) {
      const auto& wrap = c.wraps[i];
      x += box_.cell * Eigen::Vector3d(wrap[0], wrap[1], wrap[2]);
    }
    Eigen::Vector3d::Map(&positions[std::size_t{4} * i]) = x;
  }
}

void AtomArrays::place_images(const TileFlags& tiles) {
  const Candidates& c = candidates_;
  for_each_chunk(c.images.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto& [home, shift] = c.images[k];
      if (tiles[c.tile_of(home)] == 0) continue;
      Eigen::Vector3d x = Eigen::Vector3d::Map(&positions[std::size_t{4} * home]);
      for (int d = 0; d < 3; ++d) {
        const std::int16_t times = shift[static_cast<std::size_t>(d)];
        if (times != 0) x += times * box_.cell.col(d);
      }
      Eigen::Vector3d::Map(&positions[4 * (c.count() + k)]) = x;
    }
  });
}

Surroundings AtomArrays::surroundings(const Parameters& parameters) const {
  return {.parameters = parameters,
          .candidates = candidates_,
          .positions = positions.get(),
          .coordinations = coordinations.get(),
          .states = states.get()};
}

}  // namespace trivalent::potentials::rebo_detail
