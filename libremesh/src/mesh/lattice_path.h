#pragma once

#include <Eigen/Core>

#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

/// A vector x a1 + y a2 of the triangular lattice, where a2 is a1 turned by 60°.
using LatticeStep = Eigen::Vector2i;

/// Turned by 60°, counter-clockwise.
inline LatticeStep turned(const LatticeStep& v) { return {-v.y(), v.x() + v.y()}; }

/// A path along the boundary of a net, with the net on the right, in the lattice of which the net
/// is a part.
struct LatticePath {
  int edges = 0;
  int deviation = 0;  ///< Σ (valence - 4): sixths of a turn to the left, away from the net
  LatticeStep sum = LatticeStep::Zero();  ///< of its edges

  /// Turns at a vertex with valence - 4 = deviation, and goes along the edge behind it.
  void go(int deviation_there) {
    deviation += deviation_there;
    constexpr int sixths = 6;
    LatticeStep step = {1, 0};
    for (int i = 0; i < (deviation % sixths + sixths) % sixths; ++i) step = turned(step);
    sum += step;
    ++edges;
  }

  /// Distance [edges] between the sum and a tube's circumference, which may begin in any direction.
  [[nodiscard]] double distance_to(const ChiralIndices& tube) const;
};

}  // namespace trivalent::remesh
