#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rebo/bond_list.h"

namespace trivalent::potentials::rebo_detail {

/// The most strongly bonded path of up to three bonds to one atom, [Stuart2000, eq. 13].
struct Path {
  std::uint32_t atom;
  std::array<std::int32_t, 3> image;
  double strength;                   ///< product of f along the path
  std::array<std::size_t, 3> bonds;  ///< the first `length` of them
  std::size_t length;
};

/// Farthest that such a path can reach [Å].
constexpr double longest_path = 3.0 * longest_bond;

/// Finds the paths from one atom at a time.
class Paths {
 public:
  explicit Paths(const BondList& bonds) : bonds_(bonds) {}

  /// Goes on to the paths from this atom.
  void start_from(std::uint32_t atom);

  /// The best paths to all atoms that they reach.
  [[nodiscard]] std::span<const Path> all() const { return paths_; }

  /// The best path to an image of an atom; none if there is no path.
  [[nodiscard]] const Path* to(std::uint32_t atom, const std::array<std::int32_t, 3>& image) const;

 private:
  void extend(const Path& path);
  void offer(const Path& path);

  const BondList& bonds_;
  std::vector<Path> paths_;
};

}  // namespace trivalent::potentials::rebo_detail
