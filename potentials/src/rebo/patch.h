#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rebo/candidates.h"

namespace trivalent::potentials::rebo_detail {

/// A tile with what its regular atoms' terms reach, in numbers of its own: first the atoms of the
/// tile, then the *ring*, points outside linked to them, then points linked to the ring only.
///
/// With 16 bits a number all of it streams through a processor's cache once, and no other tile
/// needs to be known.
struct Patch {
  Patch() = default;
  using Shift = std::array<std::int16_t, 3>;

  struct Outside {
    std::uint32_t index;  ///< into Atoms
    Shift shift;          ///< cell vectors added to its position there
  };

  Patch(const Candidates& candidates, std::size_t tile);

  std::vector<std::uint32_t> near;     ///< tiles of all its points, itself too, sorted
  bool is_usable = false;              ///< all carbon, and not too much to count: else no more
  std::vector<Outside> outside;        ///< the ring and what is linked to it
  std::vector<std::uint16_t> ring;     ///< number of links of each point of the ring
  std::vector<std::uint16_t> point;    ///< per link of the tile's atoms, then of the ring
  std::vector<std::uint16_t> reverse;  ///< per link of the tile's atoms: the other direction

 private:
  class Builder;
};

}  // namespace trivalent::potentials::rebo_detail
