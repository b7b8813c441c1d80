#include "crystal/spring_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "crystal/annealing.h"
#include "crystal/inflation.h"
#include "crystal/spring_relaxation.h"
#include "crystal/starting_net.h"
#include "crystal/thin_parts.h"
#include "equalize/sliding.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// One annealing, at one edge length.
struct Stage {
  int coarseness;  ///< edges in target lengths
  double first_temperature;
  double core_energy;
  int rounds;
};

/// At twice the target length the net orders as a whole: hot, slow, and cheap, as vertices are few.
constexpr Stage coarse_stage = {
    .coarseness = 2, .first_temperature = 0.1, .core_energy = 0.0, .rounds = 1600};
/// How a net freezes is luck, which averages out in a large one: the coarse net is annealed as
/// often as makes this many vertices in all, and the best is taken.
constexpr int searched_vertices = 6000;
constexpr int max_searches = 4;
constexpr std::size_t max_refined = 2;  // of these, if the best ends up crossing itself
/// At the target length defects only find their places, and pairs that cost more than they relieve
/// vanish.
constexpr Stage fine_stage = {
    .coarseness = 1, .first_temperature = 0.03, .core_energy = 0.03, .rounds = 300};
/// At the target length without a coarse stage before.
constexpr Stage only_stage = {
    .coarseness = 1, .first_temperature = 0.1, .core_energy = 0.03, .rounds = 800};

constexpr int valence_rounds = 20;   // that mend the last valences outside 5 to 7
constexpr int closing_sweeps = 200;  // of the springs, once defects are at rest
constexpr int quick_closing_sweeps = 80;
constexpr int settling_sweeps = 20;  // once faces lie half inside and half outside
constexpr int opening_sweeps = 60;   // before they move
constexpr int mending_sweeps = 20;   // before what they cannot mend is found

/// Parts thinner than this [target lengths] are inflated for a coarse net.
constexpr double thinnest_for_coarse = 3.0;
/// The same if there is none: nets on limbs thicker than needed cross themselves at their own size.
constexpr double thinnest_for_fine = 1.5;

/// How the area of a net changes on the way from an inflated surface to the surface itself, times
/// the part of the surface that was inflated. Few inflated parts are left to find room by
/// themselves, so that the others keep their density.
double shrinkage(const TriMesh& inflated, const TriMesh& surface) {
  double moved = 0.0;
  for (const auto f : inflated.faces()) {
    const auto moves = [&](VertexHandle v) { return inflated.point(v) != surface.point(v); };
    if (std::ranges::any_of(f.vertices(), moves)) moved += face_area(inflated, f);
  }
  const double whole = surface_area(inflated);
  return 1.0 - moved / whole * (1.0 - surface_area(surface) / whole);
}

/// What tells good coarse nets from bad ones: over twenty seeds on the rocker-arm, its correlation
/// with REBO's energy of the finished shells is 0.75 (of the strain alone, 0.68).
double energy_of(const TriMesh& mesh, double length) {
  constexpr double core = 0.07;  // in units of the springs
  const auto irregular = std::ranges::count_if(
      mesh.vertices(), [](const auto v) { return v.valence() != (v.is_boundary() ? 4U : 6U); });
  return static_cast<double>(mesh.n_edges()) * spring_strain(mesh, length) +
         core * static_cast<double>(irregular);
}

/// Brings a net at the target length to rest on its surface, half inside and half outside.
///
/// @param crosses  Pairs of faces of the surface itself that cross.
void finish_on_surface(Net& net, const CrystalOptions& options, int crosses, SearchWatch& watch) {
  const double m = options.wanted_faces ? mean_edge_length(net.mesh) : options.target_edge_length;
  // A valence outside 5 to 7 is worth more strain than a pair of other defects.
  anneal(net.on_surface, {.length = m,
                          .core_energy = 1.0,
                          .rounds = valence_rounds,
                          .seed = options.seed,
                          .min_deviation = 2,
                          .max_new_steep = 2});
  relax_springs(net.on_surface, m,
                options.effort == Effort::quick ? quick_closing_sweeps : closing_sweeps,
                watch.question());
  straddle_surface(net.on_surface);
  settle_springs(net.on_surface, m, settling_sweeps);
  if (count_crossings(net.mesh) == 0) return;
  unfold(net.on_surface);
  if (crosses == 0) part_sheets(net.on_surface);
  smooth_crossings(net.on_surface, watch.question());
}

class SpringSearch {
 public:
  SpringSearch(const SearchSurface& surface, const CrystalOptions& options, SearchWatch& watch)
      : surface_(surface.mesh),
        creases_(surface.creases),
        options_(options),
        watch_(watch),
        area_(surface_area(surface_)),
        crossings_of_surface_(count_crossings(surface_)) {}

  std::optional<FoundNet> run() {
    std::unique_ptr<Net> net = from_coarse_net();
    bool coarse_start = net != nullptr;
    if (!net) {
      if (!watch_.stopped()) net = from_fine_net();
      if (!net) return std::nullopt;
    } else if (!watch_.stopped() && are_new(count_crossings(net->mesh))) {
      // Some thin part was still too thin for the coarse net. But a net without crossings may have
      // lost that part.
      std::unique_ptr<Net> other = from_fine_net();
      if (other && flaws(other->mesh).sum() < flaws(net->mesh).sum()) {
        net = std::move(other);
        coarse_start = false;
      }
    }
    return FoundNet{std::move(net->mesh), coarse_start};
  }

 private:
  /// Whether a net with so many crossings crosses itself more often than the surface.
  [[nodiscard]] bool are_new(int crossings_of_net) const {
    return crossings_of_net > crossings_of_surface_;
  }

  [[nodiscard]] Flaws flaws(const TriMesh& net) const {
    const double m = options_.target_edge_length;
    return find_flaws(net, surface_, m, m);
  }

  /// Null if there is no coarse net.
  std::unique_ptr<Net> from_coarse_net() {
    const double m = options_.target_edge_length;
    auto net = std::make_unique<Net>(surface_, creases_);
    if (is_too_thin(net->on_surface, 2.0 * m)) return nullptr;
    const TriMesh room = inflated(net->on_surface, thinnest_for_coarse * m).value_or(surface_);
    std::unique_ptr<Net> coarse =
        coarse_starting_net(room, creases_, area_, starting_options(2.0 * m));
    if (!coarse) return nullptr;
    net->on_surface.stay_on_sheets(sheet_reach * m);
    const double coarse_length = 2.0 * m *
                                 std::sqrt(surface_area(coarse->mesh) /
                                           area_divided(*coarse, room) / shrinkage(room, surface_));
    const int searches = searches_for(*coarse);
    watch_.expect(searches * rounds_of(coarse_stage) + rounds_of(fine_stage));
    ConstrainedMesh::State best;
    std::optional<int> min_crossings;
    for (const auto& [energy, state] :
         anneal_often(*coarse, coarse_length, coarse_stage, searches)) {
      if (min_crossings) watch_.expect(rounds_of(fine_stage));
      divide(state, *coarse, room, *net);
      refine(*net);
      const int count = count_crossings(net->mesh);
      if (!min_crossings || count < *min_crossings) {
        min_crossings = count;
        best = net->on_surface.state();
      }
      if (watch_.stopped() || !are_new(count)) break;
    }
    net->on_surface.restore(best);
    return net;
  }

  [[nodiscard]] int searches_for(const Net& coarse) const {
    if (options_.effort == Effort::quick) return 1;
    return std::clamp(searched_vertices / static_cast<int>(coarse.mesh.n_vertices()), 1,
                      max_searches);
  }

  /// Divides a coarse net onto the surface.
  void divide(const ConstrainedMesh::State& coarse_state, Net& coarse, const TriMesh& room,
              Net& net) const {
    coarse.on_surface.restore(coarse_state);
    coarse.on_surface.subdivide();
    net.on_surface.restore(carried_over(coarse.on_surface.state(), room, surface_));
  }

  /// The area of a coarse net once it is divided, half inside and half outside. Its own is less, as
  /// chords cut the surface.
  [[nodiscard]] double area_divided(const Net& coarse, const TriMesh& room) const {
    Net fine(room, creases_);
    fine.on_surface.restore(coarse.on_surface.state());
    fine.on_surface.subdivide();
    straddle_surface(fine.on_surface);
    return surface_area(fine.mesh);
  }

  /// Brings a net that comes from twice the target length to the target length.
  void refine(Net& net) {
    const double m = options_.target_edge_length;
    relax_springs(net.on_surface, m, mending_sweeps);
    mend_thin_parts(net.on_surface, surface_, m);
    anneal_net(net, m, fine_stage);
    // Moves in one sheet of a thin part do not see the other.
    if (are_new(count_crossings(net.mesh))) mend_thin_parts(net.on_surface, surface_, m);
    finish(net);
  }

  /// Null if the search was stopped before there was a net.
  std::unique_ptr<Net> from_fine_net() {
    const double m = options_.target_edge_length;
    std::unique_ptr<Net> net = first_net(surface_);
    if (!net) return nullptr;
    net = annealed_fine_net(std::move(net));
    const Flaws flaws_of_net = flaws(net->mesh);
    const double accepted = max_flawed_fraction * static_cast<double>(net->mesh.n_faces());
    if (watch_.stopped() || flaws_of_net.left_out <= accepted) return net;
    // Plates are lost from their rims inwards, unless they are thick at first.
    auto other = std::make_unique<Net>(surface_, creases_);
    const auto room = inflated(other->on_surface, thinnest_for_fine * m);
    if (!room) return net;
    const std::unique_ptr<Net> first = first_net(*room);
    if (!first) return net;
    other->on_surface.restore(carried_over(first->on_surface.state(), *room, surface_));
    other->on_surface.stay_on_sheets(sheet_reach * m);
    other = annealed_fine_net(std::move(other));
    return flaws(other->mesh).is_better_than(flaws_of_net) ? std::move(other) : std::move(net);
  }

  /// Annealed from the start, and mended if it leaves something out and is the better for it.
  std::unique_ptr<Net> annealed_fine_net(std::unique_ptr<Net> net) {
    const double m = options_.target_edge_length;
    watch_.expect(rounds_of(only_stage));
    anneal_net(*net, m, only_stage);
    const ConstrainedMesh::State annealed = net->on_surface.state();
    finish(*net);
    const Flaws flaws_of_net = flaws(net->mesh);
    if (flaws_of_net.left_out == 0.0 || watch_.should_stop()) return net;
    const ConstrainedMesh::State finished = net->on_surface.state();
    net->on_surface.restore(annealed);
    mend_thin_parts(net->on_surface, surface_, m);
    finish(*net);
    if (!flaws(net->mesh).is_better_than(flaws_of_net)) net->on_surface.restore(finished);
    return net;
  }

  void finish(Net& net) const { finish_on_surface(net, options_, crossings_of_surface_, watch_); }

  [[nodiscard]] std::unique_ptr<Net> first_net(const TriMesh& surface) const {
    return starting_net(surface, creases_, starting_options(options_.target_edge_length));
  }

  [[nodiscard]] StartingNetOptions starting_options(double length) const {
    return {.length = length, .effort = options_.effort, .should_stop = watch_.question()};
  }

  /// Vertices of a net that comes to the wanted faces by divisions, if some are wanted.
  [[nodiscard]] std::optional<int> wanted_vertices(const TriMesh& net, int coarseness) const {
    if (!options_.wanted_faces) return std::nullopt;
    return vertices_for_faces(net, *options_.wanted_faces / (coarseness * coarseness));
  }

  [[nodiscard]] int rounds_of(const Stage& stage) const {
    return static_cast<int>(std::lround(stage.rounds * effort_factor(options_.effort)));
  }

  using Candidate = std::pair<double, ConstrainedMesh::State>;  // the energy of a net, and the net

  /// Anneals the net several times, hot again each time; the best that come out, best first.
  std::vector<Candidate> anneal_often(Net& net, double length, const Stage& stage, int times) {
    std::vector<Candidate> candidates;
    for (int k = 0; k == 0 || (k < times && !watch_.stopped()); ++k) {
      anneal_net(net, length, stage);
      candidates.emplace_back(energy_of(net.mesh, length), net.on_surface.state());
    }
    std::ranges::stable_sort(candidates, {}, &Candidate::first);
    if (candidates.size() > max_refined) candidates.resize(max_refined);
    return candidates;
  }

  void anneal_net(Net& net, double length, const Stage& stage) {
    relax_springs(net.on_surface, length, opening_sweeps, watch_.question());
    if (watch_.stopped()) return;
    anneal(net.on_surface, {.length = length,
                            .core_energy = stage.core_energy,
                            .first_temperature = stage.first_temperature,
                            .rounds = rounds_of(stage),
                            .wanted_vertices = wanted_vertices(net.mesh, stage.coarseness),
                            .seed = next_seed(),
                            .after_round = [&](int) { return watch_.goes_on(net.mesh, length); }});
  }

  /// Another one for each annealing; the odd constant keeps those of small seeds apart.
  std::uint64_t next_seed() { return options_.seed + 0x9E3779B97F4A7C15ULL * annealings_++; }

  const TriMesh& surface_;
  const Creases& creases_;  // an inflated copy has the same, though its angles differ
  const CrystalOptions& options_;
  SearchWatch& watch_;
  double area_;
  int crossings_of_surface_;
  std::uint64_t annealings_ = 0;
};

}  // namespace

Flaws find_flaws(const TriMesh& net, const TriMesh& surface, double m, double reach) {
  const std::vector<double> distances = distances_from(surface, net);
  double area = 0.0;
  for (const auto f : surface.faces()) {
    const auto is_far = [&](const auto v) { return distances[index(v)] > reach; };
    if (std::ranges::any_of(f.vertices(), is_far)) area += face_area(surface, f);
  }
  return {count_crossings(net), area / (unit_triangle_area * m * m)};
}

std::optional<FoundNet> search_springs(const SearchSurface& surface, const CrystalOptions& options,
                                       SearchWatch& watch) {
  return SpringSearch(surface, options, watch).run();
}

}  // namespace trivalent::remesh
