#pragma once

#include <cstdint>
#include <vector>

#include "rebo/candidates.h"
#include "rebo/irregular_atom.h"
#include "rebo/plain_array.h"
#include "rebo/tile_flags.h"

namespace trivalent::potentials::rebo_detail {

/// What is known of the atoms in and around tiles that RegularTiles cannot evaluate. Numbered as
/// Candidates is; without a value where no such tile is near.
class AtomArrays {
 public:
  AtomArrays(const Candidates& candidates, const Box& box);

  /// Copies the positions of a tile's atoms.
  void place_tile(const AtomsView& atoms, std::size_t tile);
  /// Copies the positions of the images of the atoms of some tiles, which have been placed.
  void place_images(const TileFlags& tiles);

  [[nodiscard]] Surroundings surroundings(const Parameters& parameters) const;

  PlainArray<double> positions;            ///< four per point [Å]
  PlainArray<std::uint8_t> states;         ///< per atom, see atom_state; 0 at first
  PlainArray<std::uint32_t> bonded;        ///< per regular atom, see regular_bonds()
  PlainArray<Coordination> coordinations;  ///< per irregular atom
  std::vector<std::uint32_t> image_homes;  ///< per image

 private:
  const Candidates& candidates_;
  Box box_;
};

}  // namespace trivalent::potentials::rebo_detail
