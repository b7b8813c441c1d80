#pragma once

#include <cstdint>
#include <variant>

#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// How long crystallize() searches.
enum class Effort { quick, normal, thorough };

/// Time that an effort takes, as a multiple of the normal one.
///
/// @throws InvalidOption  if it is none of the three.
[[nodiscard]] double effort_factor(Effort effort);

struct CrystalOptions {
  double target_edge_length = 0.0;  ///< m, in the mesh's unit, > 0; must be set by the caller
  Effort effort = Effort::normal;
  std::uint64_t seed = 0;  ///< of the random moves
  /// Edges whose faces' normals differ by more than this [rad] are creases; none: no creases.
  std::optional<double> feature_angle = std::nullopt;
  /// Called now and then; the mesh returned does not depend on it.
  std::function<void(const RemeshProgress&)> on_progress = {};
  /// Asked now and then; once true, the best net so far is finished and returned.
  std::function<bool()> should_stop = {};
};

/// Remeshes a surface into a net of equal edges with few irregular vertices, placed where the
/// curvature wants them: the ground state of a crystal of springs on the surface, searched for by
/// simulated annealing [Kirkpatrick1983] of its defects.
///
/// 1. The surface is remeshed by remesh(), at twice the target length if it is large enough; parts
///    too thin to be seen that coarsely are inflated for the while.
/// 2. Defects are annealed: a patch of the net around an irregular vertex is cut out; the flips
///    (glide), collapses and splits (climb) at that vertex are tried in it and relaxed, in random
///    order, until one is accepted by the rule of [Metropolis1953]. The energy is that of springs,
///    Σ (|e|/L - 1)², plus a core energy for each irregular vertex, since a shell relieves strain
///    by buckling but cannot heal a pentagon. Patches that do not touch are tried in parallel. A
///    net of twice the length is annealed up to four times (once if it is large, or quick), and the
///    best one goes on: which one it freezes in is partly luck.
/// 3. Every face is divided into four, which keeps the defects as few; parts too thin for the
///    coarse net are mended: folds undone, tips reached, edges far from the target split or
///    collapsed; and the net is annealed again, colder, at the target length; folds that are left
///    are undone. If it still crosses itself, the other net of step 2 is tried, and at last one
///    annealed at the target length from the start; the one with the fewest crossings is taken.
///
/// Genus, orientation, boundaries and creases of the input are kept, as by remesh(). The result
/// depends on the seed, not on the number of threads.
///
/// @param mesh  As for remesh().
/// @return      `iterations` counts rounds of annealing. `stopped` tells whether should_stop ended
/// it, `coarse_start` whether the net comes from one of twice the length.
/// @throws InvalidMesh, InvalidOption  as remesh() does.
///
/// Cost: O(n) patches a round, and a fixed number of rounds.
[[nodiscard]] RemeshResult crystallize(const TriMesh& mesh, const CrystalOptions& options);

/// A method with its options.
using RemeshMethod = std::variant<CrystalOptions, RemeshOptions>;

/// crystallize() or remesh(), whichever the options are for.
///
/// @param target_edge_length  Takes the place of the one in the options.
[[nodiscard]] RemeshResult remesh_by(const TriMesh& mesh, RemeshMethod method,
                                     double target_edge_length);

}  // namespace trivalent::remesh
