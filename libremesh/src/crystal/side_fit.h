#pragma once

#include <cstdint>
#include <vector>

#include "crystal/cone_net.h"

namespace trivalent::remesh {

/// What a net should be like.
struct WantedSides {
  std::vector<double> lengths;  ///< of the side at every half-edge [edges]
  double faces;                 ///< of the net
  std::uint64_t seed = 0;
};

/// Moves disclinations until the sides are nearly as long as wanted: searches by annealing
/// [Kirkpatrick1983] for the least Σ (|s| - l)² + 2 (F - F0)²/F0 over the sides s of wanted lengths
/// l and the number of faces F of wanted number F0. That is about what stretching costs where the
/// net is flat.
void fit_sides(ConeNet& cones, const WantedSides& wanted);

}  // namespace trivalent::remesh
