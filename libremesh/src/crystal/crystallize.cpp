#include "trivalent/remesh/crystallize.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crystal/membrane_schedule.h"
#include "crystal/membrane_search.h"
#include "crystal/primitive_cell.h"
#include "crystal/tether_strength.h"
#include "equalize/paper_loop.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/periodic.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

namespace {

/// Farther than this from the net a part of the surface is left out. Carbon at rest draws back from
/// tips: from the bunny's ears by eight edges in nets of 10,000 vertices, and by more from those of
/// larger shapes. A periodic surface has no size of its own.
double max_reach(const TriMesh& surface, double m) {
  constexpr double edges = 10.0;
  constexpr double of_size = 0.055;
  if (surface.lattice.is_periodic()) return edges * m;
  return std::max(edges * m, of_size * size_of_component(surface));
}

/// The net of a crystal's primitive cell, copied into its own; none if that cell is the smallest,
/// has no number of faces near the wanted one, or no net.
std::optional<FoundNet> search_primitive_cell(const TriMesh& mesh, CrystalOptions options,
                                              SearchWatch& watch) {
  const double m = options.target_edge_length;
  const std::optional<PrimitiveCell> cell = primitive_cell(mesh, m);
  if (!cell) return std::nullopt;
  if (options.wanted_faces) {
    constexpr double max_deviation = 0.003;
    const double faces = *options.wanted_faces / cell->copies;
    const double even = 2.0 * std::round(0.5 * faces);
    if (std::abs(even - faces) > max_deviation * faces) return std::nullopt;
    options.wanted_faces = even;
  }
  const TriMesh surface = with_edges_divided(cell->surface, m);
  std::optional<FoundNet> net =
      search_membrane({surface, find_creases(surface, {})}, options, watch);
  if (!net) return std::nullopt;
  const Flaws flaws = find_flaws(net->mesh, surface, m, max_reach(surface, m));
  if (flaws.sum() > 0.0 && !watch.stopped()) return std::nullopt;
  net->mesh = in_supercell(net->mesh, mesh.lattice);
  net->copies = cell->copies;
  return net;
}

/// The net of the membrane where that is better, or else that of springs; none if the search was
/// stopped before.
std::optional<FoundNet> search(const SearchSurface& surface, const CrystalOptions& options,
                               SearchWatch& watch) {
  // On the surface a net without scars has unequal edges: 6.7 % instead of 4 % on a sphere.
  if (options.rest == NetRest::on_surface) return search_springs(surface, options, watch);
  if (auto net = search_primitive_cell(surface.mesh, options, watch)) return net;
  std::optional<FoundNet> membrane = search_membrane(surface, options, watch);
  if (watch.stopped()) return membrane;
  if (edge_length_of_tubes(surface.mesh)) {
    if (!membrane) throw InvalidMesh("crystallize: the surface is too thin for a net with tubes");
    return membrane;
  }
  if (!membrane) return search_springs(surface, options, watch);
  const double m = options.target_edge_length;
  const double reach = max_reach(surface.mesh, m);
  const Flaws flaws = find_flaws(membrane->mesh, surface.mesh, m, reach);
  const bool is_sound = flaws.left_out == 0.0 && flaws.crossings <= count_crossings(surface.mesh);
  if (is_sound) return membrane;
  std::optional<FoundNet> springs = search_springs(surface, options, watch);
  if (!springs) return membrane;
  const Flaws other = find_flaws(springs->mesh, surface.mesh, m, reach);
  return other.sum() < flaws.sum() ? std::move(springs) : std::move(membrane);
}

/// @throws InvalidOption  if the surface is to end in tubes, which nets of these options cannot.
void check_tubes(const TriMesh& surface, const CrystalOptions& options) {
  const std::optional<double> edge_length = edge_length_of_tubes(surface);
  if (!edge_length) return;
  if (options.rest == NetRest::on_surface) {
    throw InvalidOption(
        "crystallize: only nets in space, as for build, can end in tubes of given indices");
  }
  constexpr double max_strain = 0.03;
  if (std::abs(options.target_edge_length / *edge_length - 1.0) <= max_strain) return;
  throw InvalidOption(concat("crystallize: the tubes that the surface ends in need edges of ",
                             *edge_length, ", not ", options.target_edge_length,
                             "; they set its size: give no other"));
}

}  // namespace

double effort_factor(Effort effort) {
  switch (effort) {
    case Effort::quick:
      return 0.15;
    case Effort::normal:
      return 1.0;
    case Effort::thorough:
      return 4.0;
  }
  throw InvalidOption("crystallize: unknown effort");
}

double annealing_work(double vertices, Effort effort) {
  std::size_t first = 0;
  const auto vertices_of = [&](std::size_t level) {
    return vertices / (levels[level].coarseness * levels[level].coarseness);
  };
  while (vertices_of(first) < levels[first].min_vertices) ++first;
  Level level_of_order = levels[first];
  if (vertices <= max_judged_vertices) level_of_order.max_orders = max_judged_orders;
  const auto [orders, schedule] = plan_order(level_of_order, vertices_of(first), effort);
  double work = vertices_of(first) * orders * rounds_for(schedule, effort);
  // A coarse net is divided at once.
  const bool is_at_once = levels[first].coarseness >= coarse_places && effort != Effort::quick;
  for (std::size_t level = is_at_once ? levels.size() - 1 : first + 1; level < levels.size();
       ++level) {
    work += vertices_of(level) * rounds_for(is_refined(first, level) ? refining : settling, effort);
  }
  return work;
}

RemeshResult crystallize(const TriMesh& mesh, const CrystalOptions& options) {
  check_remeshable(mesh, {.target_edge_length = options.target_edge_length,
                          .feature_angle = options.feature_angle});
  if (options.stiffness && !(*options.stiffness > 0.0 && std::isfinite(*options.stiffness))) {
    throw InvalidOption(concat(
        "crystallize: the tether's stiffness must be > 0 and finite, but is ", *options.stiffness));
  }
  check_tubes(mesh, options);
  const TriMesh surface = with_edges_divided(mesh, options.target_edge_length);
  const Creases creases = find_creases(surface, options.feature_angle);
  SearchWatch watch(options);
  std::optional<FoundNet> net = search({surface, creases}, options, watch);
  if (!net) throw Stopped("crystallize: stopped before there was a net");
  const RemeshProgress state = measure_progress(net->mesh);
  RemeshResult result;
  result.mesh = std::move(net->mesh);
  result.iterations = watch.rounds_done();
  result.relative_spread = state.relative_spread;
  result.regular_fraction = state.regular_fraction;
  result.stopped = watch.stopped();
  result.coarse_start = net->coarse_start;
  result.copies = net->copies;
  return result;
}

RemeshResult remesh_by(const TriMesh& mesh, RemeshMethod method, double target_edge_length) {
  std::visit([&](auto& options) { options.target_edge_length = target_edge_length; }, method);
  if (const auto* paper = std::get_if<RemeshOptions>(&method)) return remesh(mesh, *paper);
  return crystallize(mesh, std::get<CrystalOptions>(method));
}

}  // namespace trivalent::remesh
