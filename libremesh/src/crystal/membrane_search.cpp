#include "crystal/membrane_search.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "crystal/cell_net_search.h"
#include "crystal/freed_disclinations.h"
#include "crystal/inflation.h"
#include "crystal/level_membranes.h"
#include "crystal/membrane_annealing.h"
#include "crystal/membrane_schedule.h"
#include "crystal/moved_net.h"
#include "crystal/rims.h"
#include "crystal/spring_relaxation.h"
#include "crystal/thin_parts.h"
#include "trivalent/remesh/mesh_components.h"

namespace trivalent::remesh {

namespace {

/// Parts thinner than this [edges] are inflated for the first net.
constexpr double min_thickness = 1.5;
/// [edges] that a vertex may be from its foot before another sheet is looked for.
constexpr double free_sheet_reach = 1.5;
constexpr int opening_steps = 100;
constexpr int closing_steps = 400;
constexpr int springing_sweeps = 60;  // of a net carried over from another surface
constexpr int hasty_steps = 30;       // once the user wants to stop

class MembraneSearch {
 public:
  MembraneSearch(const SearchSurface& surface, const CrystalOptions& options, SearchWatch& watch)
      : scale_(Membrane::fine_length / options.target_edge_length),
        surface_(scaled(surface.mesh, scale_)),
        creases_(surface.creases),
        options_(options),
        watch_(watch),
        membranes_(surface_, options),
        net_(surface_, creases_),
        whole_surface_(net_.on_surface.state()) {}

  std::optional<FoundNet> run() {
    bool is_coarse = carry_over();
    // The coarsest order is next to never bettered at finer lengths.
    for (std::size_t level = 0; level + 1 < levels.size() && !is_coarse; ++level) {
      is_coarse = order_from(level);
    }
    if (!is_coarse && (watch_.stopped() || !start_small())) return std::nullopt;
    if (!watch_.stopped()) try_cell_nets();
    finish_best();
    scale(net_.mesh, 1.0 / scale_);
    return FoundNet{std::move(net_.mesh), is_coarse};
  }

 private:
  static TriMesh scaled(TriMesh mesh, double factor) {
    scale(mesh, factor);
    return mesh;
  }

  /// Whether a first net of this level has room for patches, and for the tubes that it ends in.
  [[nodiscard]] bool has_room(const Level& level) const {
    return membranes_.n_vertices() >= level.coarseness * level.coarseness * level.min_vertices &&
           fits_tubes(net_.on_surface.curves(), level.coarseness);
  }

  /// Puts the first net on the surface, if it is thick enough for one.
  bool start(const Level& level) {
    const double length = level.coarseness * Membrane::fine_length;
    net_.on_surface.restore(whole_surface_);
    if (is_too_thin(net_.on_surface, length)) return false;
    const auto inflated_surface = inflated(net_.on_surface, min_thickness * length);
    StartingNetOptions options = starting_options(length);
    options.min_vertices = level.min_vertices;
    const std::unique_ptr<Net> net = coarse_starting_net(inflated_surface.value_or(surface_),
                                                         creases_, membranes_.area(), options);
    if (!net) return false;
    net_.on_surface.restore(net->on_surface.state());
    return true;
  }

  /// Whether all orders of a net are finished, and the energy of the options chooses: nets so small
  /// that it takes less time than the search.
  [[nodiscard]] bool is_judged() const {
    return options_.energy && membranes_.n_vertices() <= max_judged_vertices;
  }

  /// Orders a first net at a level, and brings it to the target length.
  ///
  /// @return  False, without a net, where the shape is too small or too thin for that level.
  bool order_from(std::size_t level) {
    if (watch_.stopped() || !has_room(levels[level]) || !start(levels[level])) return false;
    for (const Order& order : orders(levels[level])) {
      net_.on_surface.restore(order.state);
      std::size_t reached = divide_freely(level, order.wanted_lengths);
      if (reached + 1 == levels.size()) settle(levels.back(), false);
      while (++reached < levels.size()) {
        divide_in_space(net_.on_surface);
        settle(levels[reached], is_refined(level, reached));
      }
      candidates_.push_back({net_.on_surface.state()});
    }
    return true;
  }

  /// A first net that has been annealed.
  struct Order {
    double energy = std::numeric_limits<double>::infinity();
    ConstrainedMesh::State state = {};
    std::vector<double> wanted_lengths = {};  ///< of the sides of its cone net [edges], if any
  };

  /// Whether the disclinations of a first net have so few places that they are moved once more when
  /// it is divided. On thin parts, whose nets begin at twice the length, that is no gain.
  [[nodiscard]] bool has_few_places(const Level& level) const {
    return options_.effort != Effort::quick && level.coarseness >= coarse_places &&
           net_.on_surface.curves().empty() && !surface_.lattice.is_periodic();
  }

  /// Finds out where the disclinations of a net want to be, and what that is worth.
  [[nodiscard]] FreedDisclinations free(Net& net, const Level& level) const {
    MembraneNet membrane(net.on_surface, surface_, membranes_.at(level));
    return free_disclinations(membrane, membranes_.wanted_faces(level), watch_.question());
  }

  /// Divides an order into shorter edges, with its disclinations where they want to be; very coarse
  /// ones in two strides.
  ///
  /// @param lengths  Of the sides of the order's cone net [edges], or none.
  /// @return         The level reached, which is the first for want of lengths or of such a net.
  std::size_t divide_freely(std::size_t level, std::vector<double> lengths) {
    while (!lengths.empty() && level + 1 < levels.size()) {
      const std::size_t next = std::min(level + 2, levels.size() - 1);
      const int parts = levels[level].coarseness / levels[next].coarseness;
      for (double& length : lengths) length *= parts;
      const auto divided =
          divided_net(net_.mesh, net_.on_surface.surface(), parts,
                      {.lengths = std::move(lengths),
                       .faces = static_cast<double>(membranes_.wanted_faces(levels[next])),
                       .seed = options_.seed,
                       .should_stop = watch_.question()});
      if (!divided) break;
      net_.on_surface.restore(*divided);
      level = next;
      lengths =
          level + 1 < levels.size() ? free(net_, levels[level]).lengths : std::vector<double>{};
    }
    return level;
  }

  /// Anneals the net after a division.
  ///
  /// @param free_part  Of the vertices wanted: a free surface may have so many more or fewer.
  void settle(const Level& level, bool is_to_order, double free_part = free_count) {
    const auto faces = static_cast<int>(net_.mesh.n_faces());
    int wanted = membranes_.wanted_faces(level);
    // The coarse net came near to the number without a defect. Whoever changes it now leaves pairs
    // of 5-7 of about 3 eV each; a cell of a crystal has to have its number.
    const double excess = 0.5 * (faces - wanted);  // vertices
    const auto vertices = static_cast<double>(net_.mesh.n_vertices());
    const bool is_near = std::abs(excess) <= free_part * (vertices - excess);
    if (is_near && !surface_.lattice.is_periodic()) wanted = faces;
    Membrane membrane = membranes_.at(level);
    const bool is_settling = !is_to_order && wanted == faces;
    if (is_settling && level.coarseness == 1) membrane.pair = settled_pair;
    const Schedule& schedule = is_to_order ? refining : is_settling ? settling : climbing;
    watch_.expect(rounds_of(schedule));
    anneal(net_, membrane, {.schedule = schedule, .wanted = wanted, .seed = options_.seed});
  }

  /// Orders a net of the target length: small ones need no coarse one, thin ones would cross
  /// themselves.
  bool start_small() {
    constexpr double max_vertices_of_small = 1500.0;
    if (membranes_.n_vertices() > max_vertices_of_small && !membranes_.ends_in_tubes())
      return false;
    const std::unique_ptr<Net> net =
        starting_net(surface_, creases_, starting_options(Membrane::fine_length));
    if (!net) return false;
    net_.on_surface.restore(net->on_surface.state());
    for (Order& order : orders(levels.back())) candidates_.push_back({std::move(order.state)});
    return true;
  }

  /// Adds nets of a crystal's cell that come from few vertices.
  void try_cell_nets() {
    const auto division = plan_cell_division(surface_, membranes_.wanted_vertices());
    if (!division) return;
    // A remeshed start of four times the vertices; the lattice allows edges of a quarter of it.
    const double base_length = Membrane::fine_length * std::sqrt(division->triangles_each());
    const double length = std::min(0.5 * base_length, 0.24 * surface_.lattice.shortest());
    const std::unique_ptr<Net> start = starting_net(surface_, creases_, starting_options(length));
    if (!start || find_components(start->mesh).parts.size() != 1) return;
    const SurfaceProjector& projector = net_.on_surface.surface();
    constexpr int max_judged_nets = 4;
    for (const CellNet& net : search_cell_nets(start->mesh, surface_,
                                               {.division = *division,
                                               .seed = options_.seed,
                                               .runs = runs_of_cell_nets(options_.effort),
                                               .max_nets = is_judged() ? max_judged_nets : 1,
                                               .should_stop = watch_.question()})) {
      if (!net.is_simplicial()) continue;
      candidates_.push_back({state_on(projector, net), favor_of_cell_nets});
    }
  }

  /// Takes the net beside the surface over, if there is one like it.
  bool carry_over() {
    const TriMesh* beside = options_.beside;
    if (beside == nullptr || !net_.on_surface.curves().empty()) return false;
    if (!are_alike(*beside, surface_)) return false;
    const auto carried =
        carried_net(scaled(*beside, scale_), net_.on_surface.surface(),
                    {.faces = static_cast<double>(membranes_.wanted_faces(levels.back())),
                     .seed = options_.seed,
                     .should_stop = watch_.question()});
    if (!carried) return false;
    net_.on_surface.restore(*carried);
    unfold(net_.on_surface);
    relax_springs(net_.on_surface, Membrane::fine_length, springing_sweeps);
    settle(levels.back(), false, free_count_beside);
    candidates_.push_back({net_.on_surface.state()});
    return true;
  }

  [[nodiscard]] StartingNetOptions starting_options(double length) const {
    return {.length = length, .effort = options_.effort, .should_stop = watch_.question()};
  }

  /// Anneals the first net, a small one several times.
  ///
  /// @return  All orders if they are to be judged, else that of least energy.
  std::vector<Order> orders(Level level) {
    if (is_judged()) level.max_orders = max_judged_orders;
    if (!net_.on_surface.curves().empty()) level.vertex_rounds = level.vertex_rounds_with_curves;
    if (membranes_.ends_in_tubes()) {
      level.max_orders = orders_of_tubes;
      level.max_rounds *= effort_of_tubes;
      level.vertex_rounds *= effort_of_tubes;
    }
    // Half of the time is for the nets that come from few vertices.
    if (plan_cell_division(surface_, membranes_.wanted_vertices())) level.vertex_rounds *= 0.5;
    const OrderPlan plan =
        plan_order(level, static_cast<double>(net_.mesh.n_vertices()), options_.effort);
    watch_.expect(plan.orders * rounds_of(plan.schedule));
    const ConstrainedMesh::State start = net_.on_surface.state();
    std::vector<Order> found(index(plan.orders));
    const auto find = [&](std::size_t k) {
      if (watch_.stopped()) return;
      Net net(net_.on_surface, start);
      // The odd constant keeps the orders of small seeds apart.
      const std::uint64_t seed =
          options_.seed + 0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(k);
      Schedule own = plan.schedule;
      if (k % 2 == 1) own.hot = level.molten;
      found[k].energy =
          anneal(net, membranes_.at(level),
                 {.schedule = own, .wanted = membranes_.wanted_faces(level), .seed = seed});
      if (has_few_places(level) && !watch_.stopped()) {
        FreedDisclinations freed = free(net, level);
        found[k].energy = freed.energy + price_of_pairs(net.mesh, level);
        found[k].wanted_lengths = std::move(freed.lengths);
      }
      found[k].state = net.on_surface.state();
    };
    // Small nets have few patches at a time, so that their orders are found at the same time.
    tbb::parallel_for(std::size_t{0}, found.size(),
                      [&](std::size_t k) { tbb::this_task_arena::isolate([&] { find(k); }); });
    std::erase_if(found, [](const Order& order) { return !std::isfinite(order.energy); });
    if (found.empty()) return {Order{.state = start}};
    std::ranges::stable_sort(found, {}, &Order::energy);
    if (!is_judged()) found.resize(1);
    return found;
  }

  struct Annealing {
    Schedule schedule;
    int wanted;  ///< faces
    std::uint64_t seed;
  };

  /// @return  Energy of the membrane, cores and the count term included [eV].
  double anneal(Net& start, const Membrane& membrane, const Annealing& annealing) {
    start.on_surface.stay_on_sheets(free_sheet_reach * membrane.length);
    MembraneNet net(start.on_surface, surface_, membrane);
    if (watch_.stopped()) {
      net.relax(hasty_steps);
      return energy_of(net, annealing.wanted);
    }
    net.relax(opening_steps, watch_.question());
    net.renew();
    net.relax(opening_steps, watch_.question());
    const bool is_last = membrane.length == Membrane::fine_length;
    MembraneAnnealingOptions options;
    options.first_temperature = annealing.schedule.hot;
    options.last_temperature = is_last ? 0.0 : annealing.schedule.cold;
    options.rounds = rounds_of(annealing.schedule);
    options.wanted_faces = annealing.wanted;
    // Levels have random numbers of their own.
    options.seed =
        3 * annealing.seed + static_cast<std::uint64_t>(std::lround(membrane.coarseness()));
    options.after_round = [&](int) {
      return watch_.goes_on(start.mesh, membrane.length, 1.0 / scale_);
    };
    anneal_membrane(net, options);
    if (!is_last) return energy_of(net, annealing.wanted);
    options.first_temperature = 0.0;
    options.rounds = tidying_rounds;
    options.min_deviation = 2;
    options.after_round = {};
    anneal_membrane(net, options);
    return energy_of(net, annealing.wanted);
  }

  /// @param wanted  Number of faces.
  [[nodiscard]] static double energy_of(MembraneNet& net, int wanted) {
    const int faces = static_cast<int>(net.constrained().mesh.n_faces());
    return net.elastic_energy() + net.core_energy() + net.membrane().count_energy(faces - wanted) +
           rim_energy(net.membrane(), net.constrained());
  }

  [[nodiscard]] int rounds_of(const Schedule& schedule) const {
    return rounds_for(schedule, options_.effort);
  }

  /// Brings a net of the target length to rest.
  ///
  /// @return  Its energy, cores and the count term included [eV].
  double finish(Net& finished) {
    MembraneNet net(finished.on_surface, surface_, membranes_.last());
    if (watch_.stopped()) {
      net.relax(hasty_steps);
    } else {
      net.relax_across(closing_steps, watch_.question());
      net.renew();
      if (!watch_.should_stop()) net.relax_across(closing_steps, watch_.question());
    }
    return energy_of(net, membranes_.wanted_faces(levels.back()));
  }

  /// Finishes the candidates, and keeps the best.
  void finish_best() {
    if (watch_.stopped()) candidates_.resize(1);
    const auto judge = [&](Candidate& candidate) {
      Net net(net_.on_surface, candidate.state);
      candidate.energy = finish(net) - candidate.favor;
      candidate.state = net.on_surface.state();
      if (!is_judged() || candidates_.size() == 1) return;
      const double rims = rim_energy(membranes_.last(), net.on_surface);
      scale(net.mesh, 1.0 / scale_);
      candidate.energy = watch_.should_stop()
                             ? std::numeric_limits<double>::infinity()
                             : options_.energy(net.mesh) + count_energy(net.mesh) + rims;
    };
    tbb::parallel_for(std::size_t{0}, candidates_.size(), [&](std::size_t k) {
      tbb::this_task_arena::isolate([&] { judge(candidates_[k]); });
    });
    const auto best = std::ranges::min_element(candidates_, {}, &Candidate::energy);
    net_.on_surface.restore(best->state);
  }

  /// What a net of the target length costs for faces too many or too few [eV].
  [[nodiscard]] double count_energy(const TriMesh& mesh) const {
    const int excess = static_cast<int>(mesh.n_faces()) - membranes_.wanted_faces(levels.back());
    return membranes_.last().count_energy(excess);
  }

  /// A net of the target length, or what it has come to.
  struct Candidate {
    ConstrainedMesh::State state;
    double favor = 0.0;  ///< [eV] that it may be above others
    double energy = 0.0;
  };

  double scale_;  ///< from the mesh's unit to Å
  TriMesh surface_;
  const Creases& creases_;
  const CrystalOptions& options_;
  SearchWatch& watch_;
  LevelMembranes membranes_;
  Net net_;
  ConstrainedMesh::State whole_surface_;  // as it came
  std::vector<Candidate> candidates_;
};

}  // namespace

std::optional<FoundNet> search_membrane(const SearchSurface& surface, const CrystalOptions& options,
                                        SearchWatch& watch) {
  return MembraneSearch(surface, options, watch).run();
}

}  // namespace trivalent::remesh
