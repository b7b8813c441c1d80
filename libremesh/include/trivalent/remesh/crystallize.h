#pragma once

#include <cstdint>
#include <variant>

#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// How long crystallize() searches.
enum class Effort { quick, normal, thorough };

/// How strongly crystallize() holds a net in space to the surface.
enum class Follow {
  close,   ///< strongly: more defects, small distances
  carbon,  ///< as far as a shell of carbon moves at rest
  free,    ///< weakly: few defects, low energy
};

/// Where crystallize() leaves the vertices.
enum class NetRest {
  on_surface,  ///< on the surface, faces half inside and half outside, edges as equal as they can
               ///< be
  in_space,    ///< where a membrane of graphene's stiffness is at rest, near the surface
};

/// Time that an effort takes, as a multiple of the normal one.
///
/// @throws InvalidOption  if it is none of the three.
[[nodiscard]] double effort_factor(Effort effort);

struct CrystalOptions {
  double target_edge_length = 0.0;  ///< m, in the mesh's unit, > 0; must be set by the caller
  Effort effort = Effort::normal;
  std::uint64_t seed = 0;  ///< of the random moves
  Follow follow = Follow::carbon;
  NetRest rest = NetRest::on_surface;
  /// Edges whose faces' normals differ by more than this [rad] are creases; none: no creases.
  std::optional<double> feature_angle = std::nullopt;
  /// Called now and then; the mesh returned does not depend on it.
  std::function<void(const RemeshProgress&)> on_progress = {};
  /// Asked now and then; once true, the best net so far is finished and returned.
  std::function<bool()> should_stop = {};
};

/// Remeshes a surface into a net of equal edges with few irregular vertices, placed where the
/// curvature wants them: the ground state of an elastic crystal, searched for by simulated
/// annealing [Kirkpatrick1983] of its defects.
///
/// 1. The surface is remeshed by remesh(), at a multiple of the target length if it is large
///    enough; parts too thin to be seen that coarsely are inflated for the while.
/// 2. Defects are annealed: a patch of the net around an irregular vertex is cut out; the flips
///    (glide), collapses and splits (climb) at that vertex are tried in it and relaxed, in random
///    order, until one is accepted by the rule of [Metropolis1953]. Patches that do not touch are
///    tried in parallel.
/// 3. Every face is divided into four, which keeps the defects as few, and the net is annealed
///    again, colder, until the target length is reached.
///
/// In space, the energy is that of a membrane which stretches and bends like graphene, avoids
/// itself and is tethered to the surface [Seung1988]: a membrane buckles at a pentagon and so needs
/// no scars of dislocations, which a crystal on a rigid surface does. Nets on the surface have
/// springs for edges. So have those of surfaces with open boundaries or creases, or with parts too
/// thin for a net of twice the length; and where the membrane crosses itself or leaves a part out,
/// both are made and the better one is taken.
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
