#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials::rebo_detail {

/// All pairs that can become bonds before an atom has moved half the skin, with the atoms in the
/// order of space instead of the caller's.
///
/// Atoms are numbered tile by tile: a *tile* is a range of about a thousand atoms in a compact
/// piece of space, so that most pairs lie within one tile and a tile fits into a processor's cache.
/// A *point* is an atom (its number) or a periodic image of one (a number from `count` on): the
/// vector along a pair is always the difference of two points. A *link* is one direction of a pair.
struct Candidates {
  /// @param atoms  valid ones, see require_valid
  /// @param skin   [Å], >= 0
  Candidates(const AtomsView& atoms, double skin);

  [[nodiscard]] std::size_t count() const { return order.size(); }
  [[nodiscard]] std::size_t point_count() const { return order.size() + images.size(); }

  /// The atom that a point is or is an image of.
  [[nodiscard]] std::uint32_t home(std::uint32_t place) const {
    return place < order.size() ? place : images[place - order.size()].home;
  }

  [[nodiscard]] std::size_t tile_of(std::uint32_t atom) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(tiles, atom) - tiles.begin() - 1);
  }

  struct Image {
    std::uint32_t home;
    std::array<std::int16_t, 3> shift;  ///< in cell vectors
  };

  /// A pair whose atoms lie in two tiles, from one of them.
  struct Crossing {
    std::uint32_t atom;
    std::uint32_t link;
    std::uint32_t back;  ///< index of the crossing from the other side
  };

  [[nodiscard]] std::size_t tile_count() const { return tiles.size() - 1; }

  std::vector<std::uint32_t> tiles;                ///< first atom of each tile, and count()
  std::vector<std::uint32_t> first_crossing;       ///< of each tile, and their number
  std::vector<Crossing> crossings;                 ///< in the order of links
  std::vector<std::uint32_t> order;                ///< atom → index into Atoms
  std::vector<Species> species;                    ///< of each atom
  std::vector<std::array<std::int16_t, 3>> wraps;  ///< cell vectors added to each; empty if none
  std::vector<Image> images;                       ///< points from count() on
  std::vector<std::uint32_t> first;                ///< atom → its first link; one more than atoms
  std::vector<std::uint32_t> point;                ///< link → where it ends
  std::vector<std::uint32_t> reverse;              ///< link → the other direction of the pair

 private:
  class Builder;
};

}  // namespace trivalent::potentials::rebo_detail
