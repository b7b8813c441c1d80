#include "crystal/membrane_annealing.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "crystal/defect_moves.h"
#include "crystal/membrane_patch.h"
#include "equalize/valence.h"

namespace trivalent::remesh {

namespace {

/// Moves that raise Σ (valence - 6)² by more would make more than one new pair of defects at once.
constexpr int max_new_disorder = 2;
constexpr int patch_steps = 60;
constexpr int rounds_per_relaxation = 5;
constexpr int steps_per_relaxation = 25;
/// Temperatures above the last go with this power of the rounds that remain: a net orders as a
/// whole while it is hot, where rounds cost half as much.
constexpr double cooling_power = 0.7;
/// Of the temperature: how exactly the energy of a patch must be known.
constexpr double relative_tolerance = 0.06;
constexpr double min_tolerance = 0.002;  // [eV]
constexpr double min_gain = 0.01;        // [eV] at temperature 0, so that no move is made twice

/// A move that was chosen: the patch after it.
struct Decision {
  std::optional<MembranePatch> patch;
  double spare = 0.0;             // [eV] by which the limit of Metropolis' rule is above its energy
  int added = 0;                  // faces
  std::optional<int> curve = {};  // of a boundary whose number of edges changes by `added`
};

struct Workspace {
  PatchMarks marks;
  Lbfgs<float> minimizer;
};

class MembraneAnnealing {
 public:
  MembraneAnnealing(MembraneNet& net, const MembraneAnnealingOptions& options)
      : net_(net), mesh_(net.constrained().mesh), options_(options) {}

  int run() {
    int moves = 0;
    renew();
    for (int round = 0; round < options_.rounds; ++round) {
      const double remaining = 1.0 - (round + 1.0) / options_.rounds;
      temperature_ =
          options_.last_temperature + std::pow(remaining, cooling_power) *
                                          (options_.first_temperature - options_.last_temperature);
      seed_ = hashed(options_.seed, static_cast<std::uint64_t>(round));
      moves += play_round();
      if ((round + 1) % rounds_per_relaxation == 0) {
        net_.renew();
        net_.relax(steps_per_relaxation);
        renew();
      }
      if (options_.after_round && !options_.after_round(round)) break;
    }
    net_.renew();
    return moves;
  }

 private:
  /// After the whole net has changed.
  void renew() {
    mesh_.garbage_collection();
    deviations_ = valence_deviations(mesh_);
    excess_ = static_cast<int>(mesh_.n_faces()) - options_.wanted_faces;
    curve_edges_.assign(index(net_.constrained().curves().size()), 0);
    for (const auto e : mesh_.edges()) {
      if (const auto curve = net_.constrained().curve_of(e)) ++curve_edges_[index(*curve)];
    }
  }

  int play_round() {
    const std::vector<VertexHandle> sites = disjoint_sites(mesh_, deviations_,
                                                           {.rings = MembranePatch::reach.inner,
                                                            .min_deviation = options_.min_deviation,
                                                            .seed = seed_,
                                                            .on_boundaries = true});
    const double reach = contact_skin * net_.membrane().contact_distance();
    const PointGrid grid(mesh_, reach, reach);
    std::vector<Decision> decisions(sites.size());
    tbb::parallel_for(std::size_t{0}, sites.size(),
                      [&](std::size_t i) { decisions[i] = decide(sites[i], grid); });
    int moves = 0;
    for (const Decision& decision : decisions) {
      if (!decision.patch) continue;
      if (rise_of_counts(decision.added, decision.curve) > decision.spare) continue;
      apply(decision);
      ++moves;
    }
    return moves;
  }

  /// [eV] of the count terms.
  ///
  /// @param curve  Of a boundary whose number of edges changes too, by as many.
  [[nodiscard]] double rise_of_counts(int added, std::optional<int> curve) const {
    const Membrane& membrane = net_.membrane();
    const double rise = membrane.count_energy(excess_ + added) - membrane.count_energy(excess_);
    if (!curve) return rise;
    const double length = net_.constrained().curves().length(*curve);
    const int edges = curve_edges_[index(*curve)];
    return rise + membrane.boundary_count_energy(length, edges + added) -
           membrane.boundary_count_energy(length, edges);
  }

  /// The curve of the boundary edge that a move of a patch splits or collapses.
  [[nodiscard]] std::optional<int> curve_changed_by(const PatchTopology& after) const {
    if (after.added_faces() % 2 == 0) return std::nullopt;
    const PatchChange& change = after.changes().front();
    const HalfedgeHandle h =
        mesh_.find_halfedge(after.vertex(change.from), after.vertex(change.to));
    return net_.constrained().curve_of(mesh_.edge_handle(h));
  }

  /// Tries the moves at a vertex in random order and takes the first that Metropolis accepts.
  [[nodiscard]] Decision decide(VertexHandle center, const PointGrid& grid) {
    Workspace& workspace = workspaces_.local();
    const double tolerance = std::max(relative_tolerance * temperature_, min_tolerance);
    constexpr double never = 1e30;
    MembranePatch start(net_, center, grid, workspace.marks);
    Decision decision;
    if (!start.is_whole()) return decision;
    const int disorder = start.topology().disorder();
    const auto before = start.relax({patch_steps, tolerance, never}, workspace.minimizer);
    if (!before) return decision;
    std::uint64_t random = hashed(seed_, ~static_cast<std::uint64_t>(center.idx()));
    MembranePatch patch = start;
    for (const DefectMove& move : shuffled_moves(start.topology().valence(0), random)) {
      random = hashed(random, 1);
      patch = start;
      if (!make_move(patch, patch.topology(), move)) continue;
      if (patch.topology().disorder() > disorder + max_new_disorder) continue;
      const double limit = *before + largest_rise(temperature_, random, min_gain);
      const int added = patch.topology().added_faces();
      const std::optional<int> curve = curve_changed_by(patch.topology());
      const double rise = rise_of_counts(added, curve);
      const auto energy = patch.relax({patch_steps, tolerance, limit - rise}, workspace.minimizer);
      if (!energy || *energy + rise > limit) continue;
      decision.spare = limit - *energy;
      decision.added = added;
      decision.curve = curve;
      decision.patch = patch;
      break;
    }
    return decision;
  }

  void apply(const Decision& decision) {
    const PatchTopology& topology = decision.patch->topology();
    const std::vector<VertexHandle> vertices = change_connectivity(net_.constrained(), topology);
    deviations_.resize(mesh_.n_vertices(), 0);
    // What holds a vertex is found anew with the whole net, but a new one must have something.
    const int added = topology.added();
    if (topology.is_inside(added)) {
      const VertexHandle v = vertices[static_cast<std::size_t>(added)];
      Anchor anchor;
      anchor.face = net_.constrained().anchor(topology.vertex(0)).face;  // near enough
      mesh_.point(v) = decision.patch->position(added);
      if (topology.is_open(added)) {
        net_.set_anchor_on_boundary(v, anchor);
      } else {
        net_.constrained().set_anchor(v, anchor);
        net_.set_hold(v, decision.patch->hold(added));
      }
    }
    for (int i = 0; i < topology.inner_count(); ++i) {
      if (!topology.is_inside(i)) continue;
      const VertexHandle v = vertices[static_cast<std::size_t>(i)];
      deviations_[index(v)] = topology.deviation(i);
      mesh_.point(v) = decision.patch->position(i);
    }
    excess_ += decision.added;
    if (decision.curve) curve_edges_[index(*decision.curve)] += decision.added;
  }

  MembraneNet& net_;
  TriMesh& mesh_;
  const MembraneAnnealingOptions& options_;
  std::vector<int> deviations_;
  std::vector<int> curve_edges_;  // of each feature curve
  int excess_ = 0;                // faces more than wanted
  double temperature_ = 0.0;
  std::uint64_t seed_ = 0;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
};

}  // namespace

int anneal_membrane(MembraneNet& net, const MembraneAnnealingOptions& options) {
  return MembraneAnnealing(net, options).run();
}

}  // namespace trivalent::remesh
