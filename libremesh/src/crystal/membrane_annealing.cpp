#include "crystal/membrane_annealing.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "crystal/defect_moves.h"
#include "crystal/membrane_patch.h"
#include "crystal/rims.h"
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
  double spare = 0.0;  // [eV] by which the limit of Metropolis' rule is above its energy
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
    rim_energies_.clear();
    for (const Rim& rim : find_rims(net_.constrained())) {
      rim_energies_.push_back(rim_energy(net_.membrane(), net_.constrained().curves(), rim));
    }
  }

  int play_round() {
    const std::vector<VertexHandle> sites =
        disjoint_sites(mesh_, deviations_at_rims(),
                       {.rings = MembranePatch::reach.inner,
                        .min_deviation = options_.min_deviation,
                        .seed = seed_,
                        .rounds_per_boundary = rounds_per_boundary()});
    const double reach = contact_skin * net_.membrane().contact_distance();
    const PointGrid grid(mesh_, reach, reach);
    std::vector<Decision> decisions(sites.size());
    tbb::parallel_for(std::size_t{0}, sites.size(),
                      [&](std::size_t i) { decisions[i] = decide(sites[i], grid); });
    int moves = 0;
    for (const Decision& decision : decisions) {
      if (!decision.patch) continue;
      if (rise_of_counts(decision.patch->topology()) > decision.spare) continue;
      apply(decision);
      ++moves;
    }
    return moves;
  }

  /// Along the armchair end of a tube all vertices are irregular: they would leave few rounds to
  /// the defects inside.
  [[nodiscard]] std::uint64_t rounds_per_boundary() const {
    const auto is_tube = [](const FeatureCurves::Boundary& end) { return end.tube.has_value(); };
    return std::ranges::any_of(net_.constrained().curves().boundaries(), is_tube) ? 8 : 1;
  }

  /// The deviations, with all vertices irregular along rims that are not those of their tubes yet:
  /// a straight one has no other.
  [[nodiscard]] std::vector<int> deviations_at_rims() const {
    constexpr double at_rest = 5.0;  // [eV]
    const auto is_at_rest = [](double energy) { return energy < at_rest; };
    std::vector<int> deviations = deviations_;
    if (std::ranges::all_of(rim_energies_, is_at_rest)) return deviations;
    for (const auto v : mesh_.vertices()) {
      if (!v.is_boundary() || deviations[index(v)] != 0) continue;
      const int boundary = boundary_at(net_.constrained(), v);
      if (!is_at_rest(rim_energies_[index(boundary)])) deviations[index(v)] = 1;
    }
    return deviations;
  }

  /// [eV] of what a patch changes beyond its vertices: numbers of faces and of edges of boundaries,
  /// how these turn, and which tubes they end.
  [[nodiscard]] double rise_of_counts(const PatchTopology& after) const {
    const Membrane& membrane = net_.membrane();
    const int added = after.added_faces();
    double rise = membrane.count_energy(excess_ + added) - membrane.count_energy(excess_);
    const FeatureCurves& curves = net_.constrained().curves();
    if (const std::optional<int> curve = curve_changed_by(after); curve && !ends_tube(*curve)) {
      const double length = curves.length(*curve);
      const int edges = curve_edges_[index(*curve)];
      rise += membrane.boundary_count_energy(length, edges + added) -
              membrane.boundary_count_energy(length, edges);
    }
    for (const Rim& rim : rims_after(net_.constrained(), after)) {
      rise += rim_energy(membrane, curves, rim) - rim_energies_[index(rim.boundary)];
    }
    return rise;
  }

  /// Whether a curve is to be the end of a tube, whose number of edges is known.
  [[nodiscard]] bool ends_tube(int curve) const {
    const FeatureCurves& curves = net_.constrained().curves();
    const std::optional<int> boundary = curves.boundary_of(curve);
    return boundary && curves.boundaries()[index(*boundary)].tube;
  }

  /// The curve of the boundary edge that a move of a patch splits or collapses: the number of its
  /// edges changes by as many as that of the faces.
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
      const double rise = rise_of_counts(patch.topology());
      const auto energy = patch.relax({patch_steps, tolerance, limit - rise}, workspace.minimizer);
      if (!energy || *energy + rise > limit) continue;
      decision.spare = limit - *energy;
      decision.patch = patch;
      break;
    }
    return decision;
  }

  void apply(const Decision& decision) {
    const PatchTopology& topology = decision.patch->topology();
    excess_ += topology.added_faces();
    if (const auto curve = curve_changed_by(topology)) {
      curve_edges_[index(*curve)] += topology.added_faces();
    }
    for (const Rim& rim : rims_after(net_.constrained(), topology)) {
      rim_energies_[index(rim.boundary)] =
          rim_energy(net_.membrane(), net_.constrained().curves(), rim);
    }
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
  }

  MembraneNet& net_;
  TriMesh& mesh_;
  const MembraneAnnealingOptions& options_;
  std::vector<int> deviations_;
  std::vector<int> curve_edges_;      // of each feature curve
  std::vector<double> rim_energies_;  // [eV] of how each boundary turns
  int excess_ = 0;                    // faces more than wanted
  double temperature_ = 0.0;
  std::uint64_t seed_ = 0;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
};

}  // namespace

int anneal_membrane(MembraneNet& net, const MembraneAnnealingOptions& options) {
  return MembraneAnnealing(net, options).run();
}

}  // namespace trivalent::remesh
