#include "crystal/membrane_search.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "crystal/cell_net_search.h"
#include "crystal/inflation.h"
#include "crystal/membrane_annealing.h"
#include "crystal/membrane_schedule.h"
#include "crystal/rims.h"
#include "crystal/tether_strength.h"
#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/surface_shape.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

namespace {

/// Parts thinner than this [edges] are inflated for the first net.
constexpr double min_thickness = 1.5;
/// [edges] that a vertex may be from its foot before another sheet is looked for.
constexpr double free_sheet_reach = 1.5;

constexpr int opening_steps = 100;
constexpr int closing_steps = 400;
constexpr int hasty_steps = 30;  // once the user wants to stop

class MembraneSearch {
 public:
  MembraneSearch(const SearchSurface& surface, const CrystalOptions& options, SearchWatch& watch)
      : scale_(Membrane::fine_length / options.target_edge_length),
        surface_(scaled(surface.mesh, scale_)),
        creases_(surface.creases),
        options_(options),
        watch_(watch),
        area_(surface_area(surface_)),
        is_open_(has_boundary(surface_)),
        ends_in_tubes_(edge_length_of_tubes(surface_)),
        tether_factor_(is_held(options) ? 1.0 : tether_factor(surface_, area_)),
        net_(surface_, creases_),
        whole_surface_(net_.on_surface.state()) {}

  std::optional<FoundNet> run() {
    // The coarsest order is next to never bettered at finer lengths.
    bool is_coarse = false;
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

  /// Vertices of a net of the target length.
  [[nodiscard]] double n_vertices() const {
    return area_ / (2.0 * unit_triangle_area * Membrane::fine_length * Membrane::fine_length);
  }

  /// Whether a first net of this level has room for patches, and for the tubes that it ends in.
  [[nodiscard]] bool has_room(const Level& level) const {
    return n_vertices() >= level.coarseness * level.coarseness * level.min_vertices &&
           fits_tubes(net_.on_surface.curves(), level.coarseness);
  }

  /// Puts the first net on the surface, if it is thick enough for one.
  bool start(const Level& level) {
    const double length = level.coarseness * Membrane::fine_length;
    net_.on_surface.restore(whole_surface_);
    if (is_too_thin(net_.on_surface, length)) return false;
    const auto inflated_surface = inflated(net_.on_surface, min_thickness * length);
    const std::unique_ptr<Net> net = coarse_starting_net(inflated_surface.value_or(surface_),
                                                         creases_, area_, starting_options(length));
    if (!net) return false;
    net_.on_surface.restore(net->on_surface.state());
    return true;
  }

  /// Whether all orders of a net are finished, and the energy of the options chooses: nets so small
  /// that it takes less time than the search.
  [[nodiscard]] bool is_judged() const {
    return options_.energy && n_vertices() <= max_judged_vertices;
  }

  /// Orders a first net at a level, and brings it to the target length.
  ///
  /// @return  False, without a net, where the shape is too small or too thin for that level.
  bool order_from(std::size_t level) {
    if (watch_.stopped() || !has_room(levels[level]) || !start(levels[level])) return false;
    for (const ConstrainedMesh::State& order : orders(levels[level])) {
      net_.on_surface.restore(order);
      for (std::size_t finer = level + 1; finer < levels.size(); ++finer) {
        divide();
        settle(levels[finer], is_refined(level, finer));
      }
      candidates_.push_back({net_.on_surface.state()});
    }
    return true;
  }

  /// Anneals the net after a division.
  void settle(const Level& level, bool is_to_order) {
    const auto faces = static_cast<int>(net_.mesh.n_faces());
    int wanted = wanted_faces(level);
    // The coarse net came near to the number without a defect. Whoever changes it now leaves pairs
    // of 5-7 of about 3 eV each; a cell of a crystal has to have its number.
    const double excess = 0.5 * (faces - wanted);  // vertices
    const auto vertices = static_cast<double>(net_.mesh.n_vertices());
    const bool is_near = std::abs(excess) <= free_count * (vertices - excess);
    if (is_near && !surface_.lattice.is_periodic()) wanted = faces;
    Membrane membrane = membrane_at(level);
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
    if (n_vertices() > max_vertices_of_small && !ends_in_tubes_) return false;
    const std::unique_ptr<Net> net =
        starting_net(surface_, creases_, starting_options(Membrane::fine_length));
    if (!net) return false;
    net_.on_surface.restore(net->on_surface.state());
    for (ConstrainedMesh::State& order : orders(levels.back())) {
      candidates_.push_back({std::move(order)});
    }
    return true;
  }

  /// Adds nets of a crystal's cell that come from few vertices.
  void try_cell_nets() {
    const auto division = plan_cell_division(surface_, wanted_vertices());
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

  [[nodiscard]] StartingNetOptions starting_options(double length) const {
    return {.length = length, .effort = options_.effort, .should_stop = watch_.question()};
  }

  [[nodiscard]] Membrane membrane_at(const Level& level) const {
    const TetherStrength strength = tether_of(options_);
    Membrane membrane;
    membrane.length = level.coarseness * Membrane::fine_length;
    const bool is_stiffer = tether_factor_ > 1.0;
    membrane.tether = tether_factor_ * strength.tether;
    membrane.cover = (is_stiffer ? std::sqrt(tether_factor_) : tether_factor_) * strength.cover;
    membrane.slack = strength.slack / (is_stiffer ? std::sqrt(tether_factor_) : 1.0);
    membrane.pentagon = level.pentagon;
    membrane.heptagon = level.heptagon;
    membrane.octagon = level.octagon;
    membrane.ring_width = level.ring_width;
    // 0.02 lets small nets lose a fifth of their vertices; 0.3 + 60/V leaves nets of 120 one short.
    membrane.count = 0.3 + 240.0 / n_vertices();
    if (surface_.lattice.is_periodic() && level.coarseness > 1) membrane.count = exact_count;
    if (ends_in_tubes_) {
      membrane.count = count_of_tubes;
      membrane.boundary_tether = tether_of_tubes;
      if (level.coarseness == 1) membrane.pair = settled_pair;
    }
    return membrane;
  }

  /// Faces of a net that comes to those of the target length by divisions.
  [[nodiscard]] int wanted_faces(const Level& level) const {
    const double face_area = unit_triangle_area * Membrane::fine_length * Membrane::fine_length;
    const double faces =
        options_.wanted_faces.value_or(area_ / face_area) / (level.coarseness * level.coarseness);
    if (is_open_) return static_cast<int>(std::lround(faces));
    return 2 * static_cast<int>(std::lround(0.5 * faces));
  }
  /// Vertices of a closed net of the target length.
  [[nodiscard]] int wanted_vertices() const {
    return euler_characteristic(surface_) + wanted_faces(levels.back()) / 2;
  }

  /// Anneals the first net, a small one several times.
  ///
  /// @return  All orders if they are to be judged, else that of least energy.
  std::vector<ConstrainedMesh::State> orders(Level level) {
    if (is_judged()) level.max_orders = max_judged_orders;
    if (ends_in_tubes_) {
      level.max_orders = orders_of_tubes;
      level.max_rounds *= effort_of_tubes;
      level.vertex_rounds *= effort_of_tubes;
    }
    // Half of the time is for the nets that come from few vertices.
    if (plan_cell_division(surface_, wanted_vertices())) level.vertex_rounds *= 0.5;
    const OrderPlan plan =
        plan_order(level, static_cast<double>(net_.mesh.n_vertices()), options_.effort);
    watch_.expect(plan.orders * rounds_of(plan.schedule));
    const ConstrainedMesh::State start = net_.on_surface.state();
    struct Order {
      double energy = std::numeric_limits<double>::infinity();
      ConstrainedMesh::State state;
    };
    std::vector<Order> found(index(plan.orders));
    const auto find = [&](std::size_t k) {
      if (watch_.stopped()) return;
      Net net(net_.on_surface, start);
      // The odd constant keeps the orders of small seeds apart.
      const std::uint64_t seed =
          options_.seed + 0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(k);
      Schedule own = plan.schedule;
      if (k % 2 == 1) own.hot = level.molten;
      found[k].energy = anneal(net, membrane_at(level),
                               {.schedule = own, .wanted = wanted_faces(level), .seed = seed});
      found[k].state = net.on_surface.state();
    };
    // Small nets have few patches at a time, so that their orders are found at the same time.
    tbb::parallel_for(std::size_t{0}, found.size(),
                      [&](std::size_t k) { tbb::this_task_arena::isolate([&] { find(k); }); });
    std::erase_if(found, [](const Order& order) { return !std::isfinite(order.energy); });
    if (found.empty()) return {start};
    std::ranges::stable_sort(found, {}, &Order::energy);
    if (!is_judged()) found.resize(1);
    std::vector<ConstrainedMesh::State> states;
    states.reserve(found.size());
    for (Order& order : found) states.push_back(std::move(order.state));
    return states;
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

  /// Divides every face into four, in space.
  void divide() {
    TriMesh& mesh = net_.mesh;
    std::vector<Eigen::Vector3d> positions(mesh.points(), mesh.points() + mesh.n_vertices());
    positions.reserve(mesh.n_vertices() + mesh.n_edges());
    for (const auto e : mesh.edges()) {
      const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
      positions.push_back(midpoint(mesh, mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)));
    }
    net_.on_surface.subdivide();
    for (const auto v : mesh.vertices()) mesh.point(v) = positions[index(v)];
  }

  /// Of the net that is handed out. An open sheet that nothing holds would flatten.
  [[nodiscard]] Membrane final_membrane() const {
    Membrane membrane = membrane_at(levels.back());
    if (!is_held(options_) && !is_open_) membrane.tether = membrane.cover = 0.0;
    return membrane;
  }

  /// Brings a net of the target length to rest.
  ///
  /// @return  Its energy, cores and the count term included [eV].
  double finish(Net& finished) {
    MembraneNet net(finished.on_surface, surface_, final_membrane());
    if (watch_.stopped()) {
      net.relax(hasty_steps);
    } else {
      net.relax_across(closing_steps, watch_.question());
      net.renew();
      if (!watch_.should_stop()) net.relax_across(closing_steps, watch_.question());
    }
    return energy_of(net, wanted_faces(levels.back()));
  }

  /// Finishes the candidates, and keeps the best.
  void finish_best() {
    if (watch_.stopped()) candidates_.resize(1);
    const auto judge = [&](Candidate& candidate) {
      Net net(net_.on_surface, candidate.state);
      candidate.energy = finish(net) - candidate.favor;
      candidate.state = net.on_surface.state();
      if (!is_judged() || candidates_.size() == 1) return;
      const double rims = rim_energy(final_membrane(), net.on_surface);
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
    const int excess = static_cast<int>(mesh.n_faces()) - wanted_faces(levels.back());
    return final_membrane().count_energy(excess);
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
  double area_;
  bool is_open_;
  bool ends_in_tubes_;
  double tether_factor_;
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
