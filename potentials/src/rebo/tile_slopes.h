#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace trivalent::potentials::rebo_detail {

/// From (xx, yy, zz, xy, xz, yz): the upper half of a virial, zero below.
[[nodiscard]] inline Eigen::Matrix3d upper_half(const std::array<double, 6>& virial) {
  const auto [xx, yy, zz, xy, xz, yz] = virial;
  Eigen::Matrix3d upper;
  upper << xx, xy, xz, 0.0, yy, yz, 0.0, 0.0, zz;
  return upper;
}

/// What evaluating a tile gives. Used for one tile after the other, so that it stays in the cache.
struct TileSlopes {
  std::vector<double> energies;  ///< per atom of the tile, own share [eV]
  std::vector<double> links;  ///< four per link: dE/d(separation) [eV/Å], energy for the other end
  Eigen::Matrix3d virial;     ///< [eV]; its upper half in the sum over all tiles

  void clear(std::size_t atoms, std::size_t link_count) {
    energies.resize(atoms);
    links.assign(4 * link_count, 0.0);
    virial.setZero();
  }
};

}  // namespace trivalent::potentials::rebo_detail
