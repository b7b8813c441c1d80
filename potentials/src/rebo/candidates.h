#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials::rebo_detail {

/// All pairs that can become bonds before an atom has moved half the skin, with the atoms in the
/// order of space instead of the caller's.
///
/// Atoms are numbered by the cell they lie in, so that neighbors lie near each other in memory. A
/// *point* is an atom (its number) or a periodic image of one (a number from `count` on): the
/// vector along a pair is always the difference of two points. A *link* is one direction of a pair.
struct Candidates {
  /// @param atoms  valid ones, see require_valid
  /// @param skin   [Å], >= 0
  Candidates(const Atoms& atoms, double skin);

  [[nodiscard]] std::size_t count() const { return order.size(); }
  [[nodiscard]] std::size_t point_count() const { return order.size() + images.size(); }

  /// The atom that a point is or is an image of.
  [[nodiscard]] std::uint32_t home(std::uint32_t place) const {
    return place < order.size() ? place : images[place - order.size()].home;
  }

  struct Image {
    std::uint32_t home;
    std::array<std::int16_t, 3> shift;  ///< in cell vectors
  };

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
