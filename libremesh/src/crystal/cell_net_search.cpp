#include "crystal/cell_net_search.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "crystal/cell_net_places.h"
#include "crystal/defect_moves.h"
#include "crystal/membrane_minimizer.h"
#include "crystal/membrane_schedule.h"

namespace trivalent::remesh {

namespace {

constexpr double hot = 4.0;   // [eV]
constexpr double cold = 0.5;  // [eV]
constexpr int trials_per_edge = 130;
/// Every edge of a base net is divided into so many parts for its energy.
constexpr int parts_of_carbon = 2;
/// [eV/Å²] that hold the vertices of a base net to the surface: softly held nets twist around the
/// necks. Runs that found the twelve octagons of the gyroid of 384 atoms, of 192: 2 with 2, 7 with
/// 10 or 25, 9 with 80.
constexpr double tether = 50.0;
constexpr double tether_of_thinning = 20.0;
/// Who finds the way to the best net of P does so in this part of the schedule.
constexpr double first_part = 0.25;
constexpr std::size_t max_finalists = 2;
constexpr int trial_steps = 60;
constexpr int thinning_steps = 60;
constexpr int first_steps = 300;

/// Planes that hold the first vertices of a net.
using Holds = std::vector<Tether<double>>;

MembraneTerms<double> terms_of(const CellNet& net, const Membrane& membrane, VertexImages& images) {
  MembraneTerms<double> terms;
  for (int h = 0; h < net.n_halfedges(); ++h) {
    const int g = net.opposite(h);
    if (g < h) continue;
    const int a = net.from(h);
    const int b = net.to(h);
    const CellNet::Corner c = net.apex(h);
    const int to_d = CellNet::next(g);
    const double rest = membrane.rest_length(net.valence(a) - 6, net.valence(b) - 6);
    terms.hinges.push_back({a, images.number(b, net.image(h)), images.number(c.vertex, c.image),
                            images.number(net.to(to_d), net.image(to_d)),
                            static_cast<float>(rest)});
  }
  return terms;
}

Lanes<double> lanes_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z(), 0.0}; }

double cores_of(const CellNet& net, const Membrane& membrane) {
  double sum = 0.0;
  for (int v = 0; v < net.n_vertices(); ++v) sum += membrane.core_energy(net.valence(v) - 6);
  return sum;
}

/// How far a net is relaxed.
struct RelaxLimits {
  int steps;
  double limit = std::numeric_limits<double>::infinity();  ///< [eV] given up above
};

class CellNetRun {
 public:
  CellNetRun(const CellNet& start, const Lattice& lattice, const SurfaceProjector& surface,
             const CellNetOptions& options)
      : net_(start),
        surface_(&surface),
        options_(options),
        seed_(options.seed),
        // In the unit of the carbon that the energy is of: edges of the divided net have m.
        scale_(parts_of_carbon / std::sqrt(options.division.triangles_each())),
        lattice_(lattice.scaled(scale_)) {
    for (Eigen::Vector3d& p : net_.positions) p *= scale_;
    const Level& finest = levels.back();
    carbon_.pentagon = finest.pentagon;
    carbon_.heptagon = finest.heptagon;
    carbon_.octagon = finest.octagon;
    carbon_.ring_width = finest.ring_width;
  }

  /// Makes a base net of places on the surface: its shortest edges there.
  ///
  /// @param places  As many as the base net has vertices, in the unit of the lattice.
  void join(const std::vector<Eigen::Vector3d>& places) {
    std::vector<Eigen::Vector3d> kept;
    kept.reserve(places.size());
    for (const Eigen::Vector3d& place : places) {
      kept.push_back(move_a_vertex_to(scale_ * place, kept));
    }
    const auto is_kept = [&](int v) { return is_one_of(kept, net_.positions[index(v)]); };
    remove_vertices([&] { return net_.from(shortest_edge(is_kept)); }, [] {});
    start();
  }

  /// Makes a base net of any vertices.
  void thin() {
    flip_to_shorter_edges();
    spread(first_steps);
    const auto is_kept = [](int) { return false; };
    remove_vertices([&] { return net_.from(shortest_edge(is_kept)); },
                    [&] { spread(thinning_steps); });
    start();
  }

  /// Flips edges from one part of the schedule to a later one: 0 is hot, 1 is cold.
  void anneal(double begin, double end) {
    const int n_trials = trials_per_edge * net_.n_halfedges() / 2;
    const auto last = static_cast<int>(end * n_trials);
    for (auto k = static_cast<int>(begin * n_trials); is_base() && k < last; ++k) {
      if (options_.should_stop && options_.should_stop()) return;
      CellNet trial = net_;
      if (!trial.flip(random_below(net_.n_halfedges()))) continue;
      const double temperature = hot * std::pow(cold / hot, static_cast<double>(k) / n_trials);
      seed_ = hashed(seed_, 4);
      const double limit = energy_ + largest_rise(temperature, seed_, 0.0);
      const double reached = energy_of(trial, {trial_steps, limit});
      if (reached > limit) continue;
      net_ = std::move(trial);
      holds_ = holds_of(net_, tether);
      keep(reached);
    }
  }

  /// Of the best net [eV]; infinite if there is no base net.
  [[nodiscard]] double best_energy() const { return best_energy_; }
  /// The best net, in the unit of the lattice.
  [[nodiscard]] CellNet best() const {
    CellNet net = best_;
    for (Eigen::Vector3d& p : net.positions) p /= scale_;
    return net;
  }

 private:
  [[nodiscard]] double random() {
    seed_ = hashed(seed_, 3);
    return uniform(seed_);
  }
  [[nodiscard]] int random_below(int n) { return std::min(static_cast<int>(random() * n), n - 1); }

  static bool is_one_of(const std::vector<Eigen::Vector3d>& places, const Eigen::Vector3d& p) {
    return std::ranges::find(places, p) != places.end();
  }

  /// Moves the vertex nearest to a place there, but for those on places taken before.
  ///
  /// @return  Where the vertex is now: an image of the place.
  Eigen::Vector3d move_a_vertex_to(const Eigen::Vector3d& place,
                                   const std::vector<Eigen::Vector3d>& taken) {
    const auto distance = [&](const Eigen::Vector3d& p) {
      if (is_one_of(taken, p)) return std::numeric_limits<double>::infinity();
      return (lattice_.near(p, place) - p).squaredNorm();
    };
    const auto nearest = std::ranges::min_element(net_.positions, {}, distance);
    *nearest = lattice_.near(*nearest, place);
    return *nearest;
  }

  [[nodiscard]] bool is_base() const {
    return net_.n_vertices() == options_.division.base_vertices;
  }

  /// Removes vertices until there are as many as in a base net.
  ///
  /// @param next     Which goes next.
  /// @param arrange  Called after each.
  template <typename Next, typename Arrange>
  void remove_vertices(const Next& next, const Arrange& arrange) {
    const int most_tries = 20 * net_.n_vertices();
    for (int k = 0; k < most_tries && !is_base(); ++k) {
      const int v = next();
      // Its edges go, those with the shortest other diagonal first.
      while (net_.valence(v) > 3 && flip_one_away(v)) {
      }
      if (net_.valence(v) == 3) net_.remove(v);
      flip_to_shorter_edges();
      arrange();
    }
  }

  /// Holds the base net to the surface, and takes its energy; nothing if there is none.
  void start() {
    if (!is_base()) return;
    holds_ = holds_of(net_, tether);
    keep(energy_of(net_, {first_steps}));
  }

  [[nodiscard]] SurfacePoint foot_of(const Eigen::Vector3d& p) const {
    return surface_->nearest(p / scale_);
  }

  [[nodiscard]] Holds holds_of(const CellNet& net, double stiffness) const {
    Holds holds;
    for (int v = 0; v < net.n_vertices(); ++v) {
      const Eigen::Vector3d& p = net.positions[index(v)];
      const SurfacePoint foot = foot_of(p);
      holds.push_back({v, stiffness, lanes_of(lattice_.near(p, scale_ * foot.position)),
                       lanes_of(surface_->normal(foot))});
    }
    return holds;
  }

  /// Moves the vertices to the minimum of the energy, which is returned, cores included [eV].
  double relax(CellNet& net, const Membrane& membrane, const Holds& holds,
               const RelaxLimits& limits) {
    VertexImages images(net.positions.size());
    MembraneTerms<double> terms = terms_of(net, membrane, images);
    terms.tethers = holds;
    const double cores = cores_of(net, membrane);
    constexpr double tolerance = 0.01;  // [eV]
    constexpr double of_prediction = 3.0;
    const double energy =
        minimize_membrane(minimizer_, {membrane, terms, images, lattice_}, net.positions,
                          {limits.steps, tolerance}, [&](double reached, double predicted) {
                            return reached - of_prediction * predicted + cores > limits.limit;
                          });
    return energy + cores;
  }

  /// Energy of a base net as carbon; its vertices move with those of the divided net.
  double energy_of(CellNet& base, const RelaxLimits& limits) {
    CellNet fine = base.divided(parts_of_carbon, lattice_);
    const double energy = relax(fine, carbon_, holds_, limits);
    std::copy_n(fine.positions.begin(), base.positions.size(), base.positions.begin());
    return energy;
  }

  /// Among those that begin at no vertex that is kept.
  template <typename IsKept>
  [[nodiscard]] int shortest_edge(const IsKept& is_kept) {
    constexpr double scatter = 0.4;  // makes every run another net: 0.1 finds P's best less often
    int shortest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int h = 0; h < net_.n_halfedges(); ++h) {
      const double length = net_.edge_vector(h, lattice_).norm() * (1.0 + scatter * random());
      if (length >= least || is_kept(net_.from(h))) continue;
      least = length;
      shortest = h;
    }
    return shortest;
  }

  bool flip_one_away(int v) {
    std::vector<std::pair<double, int>> spokes;
    for (int h = 0; h < net_.n_halfedges(); ++h) {
      if (net_.from(h) == v) spokes.emplace_back(net_.diagonal_length(h, lattice_), h);
    }
    std::ranges::sort(spokes);
    return std::ranges::any_of(spokes, [&](const auto& spoke) { return net_.flip(spoke.second); });
  }

  void flip_to_shorter_edges() {
    constexpr double worthwhile = 0.95;
    constexpr int max_sweeps = 20;
    bool flipped = true;
    for (int sweep = 0; sweep < max_sweeps && flipped; ++sweep) {
      flipped = false;
      for (int h = 0; h < net_.n_halfedges(); ++h) {
        const double length = net_.edge_vector(h, lattice_).norm();
        if (net_.opposite(h) < h || net_.diagonal_length(h, lattice_) >= worthwhile * length)
          continue;
        flipped = net_.flip(h) || flipped;
      }
    }
  }

  /// Relaxes the net at its own edge length, and puts its vertices on the surface.
  void spread(int steps) {
    Membrane membrane;
    const int faces = net_.n_halfedges() / 3;
    const int base_faces = faces - 2 * (net_.n_vertices() - options_.division.base_vertices);
    membrane.length = parts_of_carbon * Membrane::fine_length *
                      std::sqrt(static_cast<double>(base_faces) / static_cast<double>(faces));
    relax(net_, membrane, holds_of(net_, tether_of_thinning), {steps});
    for (Eigen::Vector3d& p : net_.positions) {
      p = lattice_.near(p, scale_ * foot_of(p).position);
    }
  }

  /// After a move.
  void keep(double energy) {
    energy_ = energy;
    if (energy >= best_energy_) return;
    best_energy_ = energy;
    best_ = net_;
  }

  CellNet net_;
  CellNet best_ = net_;
  double energy_ = 0.0;  // [eV]
  double best_energy_ = std::numeric_limits<double>::infinity();
  const SurfaceProjector* surface_;
  CellNetOptions options_;
  std::uint64_t seed_;
  double scale_;
  Lattice lattice_;
  Membrane carbon_;
  Holds holds_;
  Lbfgs<double> minimizer_;
};

/// For the vertices of a base net.
std::vector<Eigen::Vector3d> places_on(const TriMesh& surface, const CellDivision& division) {
  const int octagons = -3 * euler_characteristic(surface);  // if there are no other defects
  const double spacing =
      std::sqrt(surface_area(surface) / (2.0 * unit_triangle_area * division.base_vertices));
  return find_places(surface,
                     {.saddles = octagons, .all = division.base_vertices, .spacing = spacing});
}

CellNet divided(CellNet net, const CellDivision& division, const Lattice& lattice) {
  if (division.by_sqrt3) net = net.divided_by_sqrt3(lattice);
  return net.divided(division.parts, lattice);
}

}  // namespace

std::vector<CellNet> search_cell_nets(const TriMesh& start, const TriMesh& given,
                                      const CellNetOptions& options) {
  const CellNet net = CellNet::of(start);
  const SurfaceProjector surface(given);
  std::vector<CellNetRun> runs;
  runs.reserve(index(options.runs));
  CellNetOptions own = options;
  for (int k = 0; k < options.runs; ++k) {
    own.seed = hashed(options.seed, static_cast<std::uint64_t>(k));
    runs.emplace_back(net, start.lattice, surface, own);
  }
  const auto for_each_run = [&](std::size_t count, const auto& work) {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
      tbb::this_task_arena::isolate([&] { work(runs[k]); });
    });
  };
  const std::vector<Eigen::Vector3d> places = places_on(given, options.division);
  for_each_run(runs.size(), [&](CellNetRun& run) {
    // One begins with octagons at the saddles, as in the best nets of P, D and the gyroid. Of 48
    // runs from random nets none came to that of D.
    if (&run == &runs.front()) {
      run.join(places);
    } else {
      run.thin();
    }
    run.anneal(0.0, first_part);
  });
  std::ranges::stable_sort(runs, {}, &CellNetRun::best_energy);
  for_each_run(std::min(max_finalists, runs.size()),
               [](CellNetRun& run) { run.anneal(first_part, 1.0); });
  std::ranges::stable_sort(runs, {}, &CellNetRun::best_energy);
  std::vector<CellNet> found;
  constexpr double same = 0.1;  // [eV] that runs to one net may differ by
  double last = -std::numeric_limits<double>::infinity();
  for (const CellNetRun& run : runs) {
    if (found.size() == index(options.max_nets)) break;
    if (!std::isfinite(run.best_energy()) || run.best_energy() - last < same) continue;
    last = run.best_energy();
    found.push_back(divided(run.best(), options.division, start.lattice));
    for (Eigen::Vector3d& p : found.back().positions) {
      p = start.lattice.near(p, surface.nearest(p).position);
    }
  }
  return found;
}

ConstrainedMesh::State state_on(const SurfaceProjector& surface, const CellNet& net) {
  ConstrainedMesh::State state;
  state.positions = net.positions;
  for (const Eigen::Vector3d& p : net.positions) {
    state.anchors.emplace_back().face = surface.nearest(p).face;
  }
  for (int h = 0; h < net.n_halfedges(); h += 3) {
    state.triangles.push_back({net.from(h), net.to(h), net.to(h + 1)});
  }
  return state;
}

}  // namespace trivalent::remesh
