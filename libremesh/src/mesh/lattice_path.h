#pragma once

#include "mesh/lattice_vector.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

/// A path along the boundary of a net, with the net on the right, in the lattice of which the net
/// is a part.
struct LatticePath {
  int edges = 0;
  int deviation = 0;  ///< Σ (valence - 4): sixths of a turn to the left, away from the net
  LatticeVector sum = LatticeVector::Zero();  ///< of its edges

  /// Turns at a vertex with valence - 4 = deviation, and goes along the edge behind it.
  void go(int deviation_there) {
    deviation += deviation_there;
    sum += turned(LatticeVector(1, 0), deviation);
    ++edges;
  }

  /// Distance [edges] between the sum and a tube's circumference, which may begin in any direction.
  [[nodiscard]] double distance_to(const ChiralIndices& tube) const;
};

}  // namespace trivalent::remesh
