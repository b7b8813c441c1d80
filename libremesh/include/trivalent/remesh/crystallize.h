#pragma once

#include <cstdint>
#include <variant>

#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// How long crystallize() searches.
enum class Effort { quick, normal, thorough };

/// How strongly crystallize() ties a net in space to the surface.
enum class Follow {
  close,   ///< strongly: more defects, small distances
  carbon,  ///< about as much as a carbon shell at rest deviates from its surface
  free,    ///< weakly: few defects, low energy
};

/// Where crystallize() puts the vertices.
enum class NetRest {
  on_surface,  ///< on the surface, with faces half inside and half outside and edges of one length
  in_space,    ///< where a membrane of graphene's stiffness is at rest, near the surface
};

/// Time that an effort takes, relative to Effort::normal.
///
/// @throws InvalidOption  if the value is no enumerator.
[[nodiscard]] double effort_factor(Effort effort);

struct CrystalOptions {
  double target_edge_length = 0.0;  ///< m, in the mesh's unit, > 0; must be set by the caller
  /// Number of faces that the net should have, if that matters more than the length of its edges.
  /// Those of a free surface may miss it by 1 %, where only pairs of 5-7 would make up for it.
  std::optional<double> wanted_faces = {};
  Effort effort = Effort::normal;
  std::uint64_t seed = 0;  ///< of the random moves
  Follow follow = Follow::carbon;
  /// Stiffness of the tether between net and surface [eV/Å² for each vertex], > 0, in place of
  /// `follow`: 0.02 is about as close, 0.006 as carbon, 0.002 as free.
  std::optional<double> stiffness = {};
  NetRest rest = NetRest::on_surface;
  /// Net at rest beside the surface, such as the next wall of carbon, or null. A net in space has
  /// its disclinations above those of this one, where both are closed, of one component and of the
  /// same genus, and there are no creases.
  const TriMesh* beside = nullptr;
  /// Energy of a net in space above that of a flat one [eV], in the mesh's unit. If given, a small
  /// net is ordered more often, and the order whose energy is least is returned; if empty, the
  /// energy of the membrane decides.
  /// Several threads may call it.
  std::function<double(const TriMesh& net)> energy = {};
  /// Edges whose faces' normals differ by more than this [rad] are creases. If empty, there are
  /// none.
  std::optional<double> feature_angle = std::nullopt;
  /// Called every few rounds; the mesh returned does not depend on it.
  std::function<void(const RemeshProgress&)> on_progress = {};
  /// Called at least every round; once it returns true, the best net so far is finished hastily and
  /// returned.
  std::function<bool()> should_stop = {};
};

/// Remeshes a surface into a net of equal edges with few irregular vertices, placed where the
/// curvature requires them: the ground state of an elastic crystal, found by simulated annealing
/// [Kirkpatrick1983] of its defects.
///
/// 1. Remeshes the surface by remesh(), at a multiple of the target length if the surface is large
///    enough. Parts too thin for that length are inflated meanwhile.
/// 2. Anneals defects: cuts out a patch around an irregular vertex, tries the flips (glide),
///    collapses and splits (climb) at that vertex in random order, relaxes each, and takes the
///    first that the rule of [Metropolis1953] accepts. Patches that do not touch are tried in
///    parallel.
/// 3. Divides every face into four, which adds no defects, and anneals again at lower temperature,
///    until the target length is reached.
///
/// On closed surfaces without creases, a net in space that begins at four times the target length
/// or more has few places for its disclinations. It is divided at once, with them where the
/// membrane wants them: a net without other defects follows from where its disclinations lie in its
/// own flat metric [Thurston1998]. Quick searches leave that out.
///
/// In space, the energy is that of a membrane which stretches and bends like graphene, avoids
/// itself and is tethered to the surface [Seung1988]. A membrane buckles at a pentagon and needs no
/// scars of dislocations, unlike a crystal on a rigid surface. Creases stay where they are; an
/// open edge is held to its place along the surface, but may leave it as the rest of the net does.
/// Nets on the surface have springs as edges; so do nets on surfaces with parts too thin for a net
/// of twice the length. Where the membrane crosses itself or leaves a part out, both nets are made
/// and the better one is returned.
///
/// In space, a surface periodic along three directions that translations shorter than its cell map
/// onto itself gets the net of its primitive cell, copied; if that is five edges long, at least.
///
/// Genus, orientation, boundaries and creases of the input are kept, as by remesh(). The result
/// depends on the seed, not on the number of threads.
///
/// @param mesh  As for remesh().
/// @return      `iterations` counts rounds of annealing.
/// @throws InvalidMesh    as remesh() does, and if the surface is too thin for tubes it ends in.
/// @throws InvalidOption  as remesh() does, and if the stiffness is not > 0 and finite. Also if the
///   surface ends in tubes (tube_ends.h), and m is more than 3 % off their edges or the net is to
///   stay on the surface.
/// @throws Stopped  if options.should_stop returns true before there is a net.
///
/// Cost: O(n) patches a round, and a fixed number of rounds.
[[nodiscard]] RemeshResult crystallize(const TriMesh& mesh, const CrystalOptions& options);

/// How much annealing crystallize() does on a smooth closed surface, thick enough for coarse nets:
/// the sum over all rounds of the vertices of the net that is annealed. Its time goes with it.
///
/// @param vertices  of the net at the target length, > 0
[[nodiscard]] double annealing_work(double vertices, Effort effort);

/// A remeshing method with its options.
using RemeshMethod = std::variant<CrystalOptions, RemeshOptions>;

/// Calls crystallize() or remesh(), depending on the options.
///
/// @param target_edge_length  Replaces the one in the options.
[[nodiscard]] RemeshResult remesh_by(const TriMesh& mesh, RemeshMethod method,
                                     double target_edge_length);

}  // namespace trivalent::remesh
