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
/// [Kirkpatrick1983] for the least Σ (|s| - l)² + 20 (F - F0)²/F0 over the sides s of wanted
/// lengths l and the number of faces F of wanted number F0. The first is about what stretching
/// costs; the second keeps walls of onions at their distances.
void fit_sides(ConeNet& cones, const WantedSides& wanted);

}  // namespace trivalent::remesh
