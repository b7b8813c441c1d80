#pragma once

#include <cstdint>
#include <vector>

namespace trivalent::potentials::rebo_detail {

/// One value per tile, 0 or 1; bytes, as several threads write to them.
using TileFlags = std::vector<std::uint8_t>;

/// Tiles that are in one or the other.
[[nodiscard]] inline TileFlags united(TileFlags tiles, const TileFlags& others) {
  for (std::size_t tile = 0; tile < others.size(); ++tile) tiles[tile] |= others[tile];
  return tiles;
}

}  // namespace trivalent::potentials::rebo_detail
