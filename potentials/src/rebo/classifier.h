#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rebo/atom_arrays.h"
#include "rebo/candidates.h"
#include "rebo/parameters.h"
#include "rebo/tile_flags.h"

namespace trivalent::potentials::rebo_detail {

/// Tells regular atoms from irregular ones: fills in the states, the bonds of regular atoms and the
/// coordinations of irregular ones.
class Classifier {
 public:
  /// All three must outlive it.
  Classifier(const Parameters& parameters, const Candidates& candidates, AtomArrays& atoms)
      : parameters_(parameters),
        candidates_(candidates),
        atoms_(atoms),
        irregular_(candidates.tile_count()) {}

  /// Forgets which atoms are irregular.
  void clear();
  /// Classifies the atoms of some tiles; they and their neighbors have been placed.
  void classify(const TileFlags& tiles);

  /// The irregular atoms of a tile.
  [[nodiscard]] std::span<const std::uint32_t> irregular(std::size_t tile) const {
    return irregular_[tile];
  }
  /// Tiles that have irregular atoms.
  [[nodiscard]] TileFlags irregular_tiles() const;

 private:
  void classify_tile(std::size_t tile);
  [[nodiscard]] bool is_regular(std::uint32_t atom, const Surroundings& in);
  void count_neighbors(std::uint32_t atom, const Surroundings& in);
  void mark_around(std::uint32_t irregular);
  void mark(std::uint32_t atom, std::uint8_t state);

  const Parameters& parameters_;
  const Candidates& candidates_;
  AtomArrays& atoms_;
  std::vector<std::vector<std::uint32_t>> irregular_;  // atoms, per tile
};

}  // namespace trivalent::potentials::rebo_detail
