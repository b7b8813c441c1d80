#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "rebo/parameters.h"
#include "rebo/regular_kernel.h"

namespace trivalent::potentials::rebo_detail {

/// The three bonds of a carbon, packed, if they are at full bonds to carbons, nothing lies in the
/// switching range, and no angle is nearly straight.
///
/// @param cutoff      of bonds between carbons [Å]
/// @param links       how many pairs the atom has
/// @param separation  separation(k) is the vector along pair k [Å]
/// @param is_carbon   is_carbon(k) tells whether pair k ends at one
template <typename Separation, typename IsCarbon>
[[nodiscard]] std::optional<std::uint32_t> regular_bonds(const Range& cutoff, std::uint32_t links,
                                                         const Separation& separation,
                                                         const IsCarbon& is_carbon) {
  constexpr std::uint32_t max_links = 256;  // what eight bits can count
  if (links < 3 || links > max_links) return std::nullopt;
  std::array<Eigen::Vector3d, 3> bonds;
  std::array<double, 3> squares;
  std::array<std::uint32_t, 3> offsets{};
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < links; ++k) {
    const Eigen::Vector3d bond = separation(k);
    const double square = bond.squaredNorm();
    if (square >= cutoff.end * cutoff.end) continue;
    if (count == 3 || square > cutoff.begin * cutoff.begin || square == 0.0) return std::nullopt;
    if (!is_carbon(k)) return std::nullopt;
    bonds[count] = bond;
    squares[count] = square;
    offsets[count++] = k;
  }
  if (count != 3) return std::nullopt;
  // cosθ < -0.995, or three atoms on a line the other way round, without a square root.
  const auto is_straight = [&](std::size_t a, std::size_t b) {
    const double product = bonds[a].dot(bonds[b]);
    constexpr double limit = straight_angle.end * straight_angle.end;
    return product * product > limit * squares[a] * squares[b];
  };
  if (is_straight(0, 1) || is_straight(0, 2) || is_straight(1, 2)) return std::nullopt;
  return pack_bonds(offsets[0], offsets[1], offsets[2]);
}

}  // namespace trivalent::potentials::rebo_detail
