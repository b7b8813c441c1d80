#include "crystal/annealing.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "crystal/defect_moves.h"
#include "crystal/net_patch.h"
#include "crystal/spring_relaxation.h"
#include "equalize/valence.h"

namespace trivalent::remesh {

namespace {

constexpr int patch_rings = 3;          // that move; a fourth one is fixed
constexpr int sweeps_before_moves = 8;  // over a patch before moves are tried
/// A move is relaxed a few sweeps at a time, and given up once its energy is so much too high that
/// further sweeps would hardly ever bring it down. Tighter bounds lose the moves that need many
/// sweeps, and end in worse nets.
struct Trial {
  int sweeps;
  int rings;  // that move
  double hopeless;
};
constexpr std::array<Trial, 4> trials = {
    {{3, 2, 0.1}, {2, patch_rings, 0.03}, {2, patch_rings, 0.01}, {2, patch_rings, 0.0}}};
/// Moves that raise Σ (valence - 6)² by more would make more than one new pair of defects at once.
constexpr int max_disorder_of_move = 2;
/// λ of the energy λ x² for x vertices more than wanted, and how steeply it may rise: a net that is
/// far off must not be torn.
constexpr double count_stiffness = 0.01;
constexpr double max_count_slope = 0.1;
constexpr double min_spring_gain = 1e-4;  // at temperature 0, so that rounding errors move nothing
constexpr int rounds_per_sweeps = 10;     // 20 leave edges of a third of the length in thin parts
constexpr int sweeps_per_relaxation = 4;

/// A move that was chosen: the patch after it, and where its vertices sit on the surface.
struct SpringDecision {
  std::optional<NetPatch> patch;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Anchor> anchors;
  std::vector<MotionFrame> frames;
  double spare = 0.0;  // by which the limit of Metropolis' rule is above its energy
  int added = 0;       // vertices
};

class Annealing {
 public:
  Annealing(ConstrainedMesh& constrained, const AnnealingOptions& options)
      : constrained_(constrained),
        mesh_(constrained.mesh),
        options_(options),
        length_(options.length) {}

  int run() {
    int moves = 0;
    look_again();
    for (int round = 0; round < options_.rounds; ++round) {
      const double remaining = 1.0 - (round + 1.0) / options_.rounds;
      temperature_ = options_.first_temperature * remaining;
      seed_ = hashed(options_.seed, static_cast<std::uint64_t>(round));
      const std::vector<VertexHandle> sites = disjoint_sites(
          mesh_, deviations_,
          {.rings = patch_rings, .min_deviation = options_.min_deviation, .seed = seed_});
      std::vector<SpringDecision> decisions(sites.size());
      tbb::parallel_for(std::size_t{0}, sites.size(),
                        [&](std::size_t i) { decisions[i] = decide(sites[i]); });
      for (const SpringDecision& decision : decisions) {
        if (!decision.patch || rise_of_count(decision.added) > decision.spare) continue;
        apply(decision);
        ++moves;
      }
      if ((round + 1) % rounds_per_sweeps == 0) {
        relax_springs(constrained_, length_, sweeps_per_relaxation);
        look_again();
      }
      if (options_.after_round && !options_.after_round(round)) break;
    }
    mesh_.garbage_collection();
    return moves;
  }

 private:
  /// After the whole net has changed.
  void look_again() {
    mesh_.garbage_collection();
    deviations_ = valence_deviations(mesh_);
    frames_ = motion_frames(constrained_);
    if (!options_.wanted_vertices) return;
    excess_ = static_cast<int>(mesh_.n_vertices()) - *options_.wanted_vertices;
    length_ = mean_edge_length(mesh_);
  }

  [[nodiscard]] double rise_of_count(int added) const {
    if (!options_.wanted_vertices || added == 0) return 0.0;
    const double slope = count_stiffness * (2.0 * excess_ + added);
    return added * std::clamp(slope, -max_count_slope, max_count_slope);
  }

  [[nodiscard]] double energy_of(const NetPatch& patch) const {
    return patch.strain(length_) + options_.core_energy * patch.topology().disorder();
  }

  /// Tries the moves at a vertex in random order and takes the first that Metropolis accepts.
  [[nodiscard]] SpringDecision decide(VertexHandle center) {
    SpringDecision decision;
    NetPatch start(constrained_, frames_, center, patch_rings, marks_.local());
    if (!start.is_whole()) return decision;
    const int disorder = start.topology().disorder();
    // Thin parts have some already.
    const int max_steep = start.steep_corners() + options_.max_new_steep;
    start.relax(length_, sweeps_before_moves);
    const double energy = energy_of(start);
    std::uint64_t random = hashed(seed_, ~static_cast<std::uint64_t>(center.idx()));
    NetPatch patch = start;
    for (const DefectMove& move : shuffled_moves(start.topology().valence(0), random)) {
      random = hashed(random, 1);
      patch = start;
      if (!make_move(patch, patch.topology(), move) ||
          patch.topology().disorder() > disorder + max_disorder_of_move)
        continue;
      const int added = patch.topology().added_faces() / 2;  // boundaries keep their vertices
      const double limit =
          energy + largest_rise(temperature_, random, min_spring_gain) - rise_of_count(added);
      const bool is_hopeless = std::ranges::any_of(trials, [&](const Trial& trial) {
        patch.relax(length_, trial.sweeps, start.topology().count_within(trial.rings));
        return energy_of(patch) > limit + trial.hopeless;
      });
      if (is_hopeless || patch.steep_corners() > max_steep) continue;
      decision.patch = patch;
      decision.added = added;
      decision.spare = limit - energy_of(patch) + rise_of_count(added);
      project(decision);
      if (decision.patch->steep_corners() > max_steep) decision.patch.reset();
      break;
    }
    return decision;
  }

  /// Puts the patch onto the surface.
  void project(SpringDecision& decision) const {
    NetPatch& patch = *decision.patch;
    const Anchor center = constrained_.anchor(patch.topology().vertex(0));
    for (int i = 0; i < patch.topology().inner_count(); ++i) {
      const VertexHandle v = patch.topology().vertex(i);
      Anchor anchor;
      anchor.face = center.face;  // near enough for a new vertex
      if (v.is_valid()) anchor = constrained_.anchor(v);
      Eigen::Vector3d position = patch.position(i);
      if (patch.is_free(i)) {
        position = constrained_.project(position, anchor);
        patch.set_position(i, position);
      }
      decision.positions.push_back(position);
      decision.anchors.push_back(anchor);
      decision.frames.push_back(patch.is_free(i) ? motion_frame(constrained_, position, anchor)
                                                 : MotionFrame());
    }
  }

  void apply(const SpringDecision& decision) {
    const NetPatch& patch = *decision.patch;
    const std::vector<VertexHandle> vertices = change_connectivity(constrained_, patch.topology());
    excess_ += decision.added;
    deviations_.resize(mesh_.n_vertices(), 0);
    frames_.resize(mesh_.n_vertices());
    for (int i = 0; i < patch.topology().inner_count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!patch.topology().is_inside(i)) continue;
      deviations_[index(vertices[k])] = patch.topology().deviation(i);
      if (!patch.is_free(i)) continue;
      mesh_.point(vertices[k]) = decision.positions[k];
      constrained_.set_anchor(vertices[k], decision.anchors[k]);
      frames_[index(vertices[k])] = decision.frames[k];
    }
  }

  ConstrainedMesh& constrained_;
  TriMesh& mesh_;
  const AnnealingOptions& options_;
  double length_;  // of an edge without strain
  std::vector<int> deviations_;
  std::vector<MotionFrame> frames_;
  int excess_ = 0;  // vertices more than wanted
  double temperature_ = 0.0;
  std::uint64_t seed_ = 0;
  tbb::enumerable_thread_specific<PatchMarks> marks_;
};

}  // namespace

int anneal(ConstrainedMesh& constrained, const AnnealingOptions& options) {
  return Annealing(constrained, options).run();
}

}  // namespace trivalent::remesh
