#pragma once

#include <functional>
#include <vector>

#include "crystal/membrane_net.h"

namespace trivalent::remesh {

/// A net whose disclinations lie anywhere.
struct FreedDisclinations {
  double energy;                ///< of the membrane, cores and the count term included [eV]
  std::vector<double> lengths;  ///< of the sides at all half-edges [edges]
};

/// Lets the disclinations of a closed net lie anywhere, not only on points of its lattice: moves
/// them and the vertices to the minimum of the membrane's energy. Edges at rest are as long as in
/// the flat metric of these disclinations. A net of longer edges than the final one has too few
/// places for them. Disclinations in pairs stay where they are.
///
/// @param net           At rest; its vertices move.
/// @param wanted_faces  Of the net.
/// @return  With sides of the net's ConeNet.
[[nodiscard]] FreedDisclinations free_disclinations(MembraneNet& net, int wanted_faces,
                                                    const std::function<bool()>& should_stop = {});

}  // namespace trivalent::remesh
