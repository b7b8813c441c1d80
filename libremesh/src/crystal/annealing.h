#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Energies are in units of Σ (|e|/L - 1)²; one such unit is about 55 eV of graphene.
struct AnnealingOptions {
  double length = 0.0;             ///< L, the edge length without strain
  double core_energy = 0.0;        ///< of a vertex, times (valence - 6)²
  double first_temperature = 0.0;  ///< falls linearly to 0
  int rounds = 0;
  /// If given, a net with more vertices or fewer is drawn to so many, and edges are without strain
  /// at their mean length.
  std::optional<int> wanted_vertices = {};
  std::uint64_t seed = 0;
  int min_deviation = 1;  ///< of a valence from 6, for a vertex to be tried
  /// Maximum number of steep face corners a move may add.
  int max_new_steep = 0;
  /// Called after every round with its number, from 0; annealing ends once it returns false.
  std::function<bool(int)> after_round = {};
};

/// Anneals the defects of a net. Every round cuts out patches around irregular vertices, as many as
/// fit without touching, in random order; tries the moves at each of these vertices in its patch,
/// in random order too; and takes the first that the rule of [Metropolis1953] accepts, if any. That
/// finds a move after few tries while it is hot, and looks at all of them when it is cold. Every
/// few rounds the whole net is relaxed.
///
/// Patches are tried in parallel and changed one after the other: the result is the same on any
/// number of threads.
///
/// @return Number of moves taken.
int anneal(ConstrainedMesh& constrained, const AnnealingOptions& options);

}  // namespace trivalent::remesh
