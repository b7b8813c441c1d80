#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "crystal/cone_net.h"

namespace trivalent::remesh {

/// What a net should be like.
struct WantedSides {
  std::vector<double> lengths = {};  ///< of the side at every half-edge [edges]
  double faces = 0.0;                ///< of the net
  std::uint64_t seed = 0;
  std::function<bool()> should_stop = {};  ///< asked at least once a second
};

/// Moves disclinations until the sides are nearly as long as wanted: searches by annealing
/// [Kirkpatrick1983] for the least Σ (|s| - l)² + 20 (F - F0)²/F0 over the sides s of wanted
/// lengths l and the number of faces F of wanted number F0. The first is about what stretching
/// costs; the second keeps walls of onions at their distances. Ends with the best net so far once
/// it should stop.
void fit_sides(ConeNet& cones, const WantedSides& wanted);

}  // namespace trivalent::remesh
