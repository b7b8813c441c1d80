#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "rebo/candidates.h"
#include "rebo/plain_array.h"
#include "rebo/tile_slopes.h"
#include "totals.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials::rebo_detail {

/// Adds up the forces and energies of atoms from the slopes of their links, first within each tile,
/// then across tiles. In each of the two sweeps tiles are independent.
class ForceSums {
 public:
  explicit ForceSums(const Candidates& candidates);

  /// Sets forces and energies of a tile's atoms from the links within it, and keeps the slopes of
  /// those that lead out of it.
  ///
  /// @return  the tile's energy and virial, which need no other tile
  [[nodiscard]] Totals set_tile(std::size_t tile, const TileSlopes& slopes, EnergyForces& result);

  /// Adds what other tiles kept for this one; all tiles have been set.
  void add_crossings(std::size_t tile, EnergyForces& result) const;

 private:
  void prefetch_result(std::size_t atom, const EnergyForces& result) const;

  const Candidates& candidates_;
  // Per crossing: slope of its link and energy for the other end.
  PlainArray<Eigen::Vector4d> crossings_;
};

}  // namespace trivalent::potentials::rebo_detail
