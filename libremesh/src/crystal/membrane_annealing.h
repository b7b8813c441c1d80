#pragma once

#include <cstdint>
#include <functional>

#include "crystal/membrane_net.h"

namespace trivalent::remesh {

struct MembraneAnnealingOptions {
  double first_temperature = 0.0;  ///< [eV]; falls to the last, slowly at first
  double last_temperature = 0.0;   ///< [eV]
  int rounds = 0;
  int wanted_faces = 0;  ///< F0
  std::uint64_t seed = 0;
  int min_deviation = 1;  ///< of a valence from 6, for a vertex to be tried
  /// Called after every round with its number, from 0; annealing ends once it returns false.
  std::function<bool(int)> after_round = {};
};

/// Anneals the defects of a membrane. Every round cuts out patches around irregular vertices, as
/// many as fit without touching, in random order; tries the moves at each of these vertices in its
/// patch, in random order too; and takes the first that the rule of [Metropolis1953] accepts, if
/// any. Every few rounds the whole net relaxes.
///
/// Patches are tried in parallel and applied one after the other: the result is the same on any
/// number of threads.
///
/// @return Number of moves taken.
int anneal_membrane(MembraneNet& net, const MembraneAnnealingOptions& options);

}  // namespace trivalent::remesh
