#pragma once

#include <cstdint>
#include <vector>

#include "crystal/patch_topology.h"

namespace trivalent::remesh {

/// A random number that depends on nothing but its arguments.
[[nodiscard]] inline std::uint64_t hashed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a * 0x9E3779B97F4A7C15ULL + b;  // the steps of SplitMix64
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// In [0, 1).
[[nodiscard]] inline double uniform(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1.0p-53;
}

/// How much the energy may rise by a move that [Metropolis1953] accepts: exp(-rise/T) is at least
/// the random number in [0, 1).
///
/// @param min_gain  By which it must fall at temperature 0.
[[nodiscard]] double largest_rise(double temperature, std::uint64_t random, double min_gain);

/// A move at the center of a patch: of the spoke number k, or of the rim beyond it.
struct DefectMove {
  enum class Kind : std::uint8_t { flip_spoke, flip_rim, collapse, split } kind;
  int k;
};

/// All moves at a center of this valence, in random order.
[[nodiscard]] std::vector<DefectMove> shuffled_moves(int valence, std::uint64_t seed);

/// Makes a move in a patch, and mends valences after a collapse or split.
///
/// @return False, with the patch unchanged, where it is not possible.
template <typename Patch>
bool make_move(Patch& patch, const PatchTopology& topology, const DefectMove& move) {
  const int spoke = topology.neighbor(0, move.k);
  const int next = topology.next_in_ring(0, spoke);
  switch (move.kind) {
    case DefectMove::Kind::flip_spoke:
      return patch.flip(0, spoke);
    case DefectMove::Kind::flip_rim:
      return next >= 0 && patch.flip(spoke, next);
    case DefectMove::Kind::collapse:
      if (!patch.collapse(0, spoke)) return false;
      break;
    case DefectMove::Kind::split:
      if (!patch.split(0, spoke)) return false;
      break;
  }
  patch.mend_valences();
  return true;
}

/// Which vertices are tried in a round.
struct SiteChoice {
  int rings;              ///< vertices up to so many edges from two sites are different ones
  int min_deviation = 1;  ///< of the valence from 6, or 4 on a boundary
  std::uint64_t seed = 0;
  /// Vertices of open edges are tried once in so many rounds; 0: never.
  std::uint64_t rounds_per_boundary = 0;
};

/// Irregular vertices in random order, those left out whose patch would touch an earlier one.
///
/// @param deviations  Of every vertex's valence.
[[nodiscard]] std::vector<VertexHandle> disjoint_sites(const TriMesh& mesh,
                                                       const std::vector<int>& deviations,
                                                       const SiteChoice& choice);

/// Repeats a patch's changes on the mesh.
///
/// @return The vertices of the patch, by number; invalid where there is none.
std::vector<VertexHandle> change_connectivity(ConstrainedMesh& constrained,
                                              const PatchTopology& topology);

}  // namespace trivalent::remesh
