#include "trivalent/remesh/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "equalize/constrained_mesh.h"
#include "equalize/paper_loop.h"
#include "equalize/relaxation.h"
#include "equalize/sliding.h"
#include "equalize/stellar.h"
#include "equalize/valence.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"

namespace trivalent::remesh {

namespace {

constexpr double area_of_equilateral = 0.25 * std::numbers::sqrt3;  // triangle of edge 1

void check_options(const TriMesh& mesh, const RemeshOptions& options) {
  if (mesh.n_faces() == 0) throw InvalidMesh("remesh: the mesh has no faces");
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) {
      throw InvalidMesh(concat("remesh: vertex ", v.idx(), " belongs to no face; remove it"));
    }
  }
  const double m = options.target_edge_length;
  if (!(m > 0.0) || !std::isfinite(m)) {
    throw InvalidOption(
        concat("remesh: target edge length is ", m, "; it must be a positive number"));
  }
  if (options.iterations < 1 || options.iterations > 1000) {
    throw InvalidOption(
        concat("remesh: ", options.iterations, " iterations; 1 to 1000 are possible"));
  }
  if (options.rings < 1 || options.rings > 8) {
    throw InvalidOption(concat("remesh: ", options.rings, " rings; 1 to 8 are possible"));
  }
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0)) {
    throw InvalidOption(
        concat("remesh: tolerance σ/m is ", options.tolerance, "; it must lie between 0 and 1"));
  }
  if (options.feature_angle && !(*options.feature_angle > 0.0)) {
    throw InvalidOption(
        concat("remesh: feature angle is ", *options.feature_angle, " rad; it must be positive"));
  }
}

/// More would not fit into the memory of most machines (about 1 kB per face).
constexpr double most_faces = 2e7;

void check_that_target_fits(const TriMesh& mesh, double target) {
  double area = 0.0;
  const MeshComponents components = find_components(mesh);
  for (std::size_t i = 0; i < components.parts.size(); ++i) {
    const MeshComponent& component = components.parts[i];
    area += component.area;
    if (!(component.area > 0.0) || !std::isfinite(component.area)) {
      throw InvalidMesh(concat("remesh: a part of the mesh has the area ", component.area,
                               "; remove flat parts, or scale the mesh to ordinary numbers"));
    }
    const double largest = longest_edge_for(component.area, component.is_closed());
    if (target > largest) {
      throw InvalidOption(concat("remesh: a target edge length of ", target, " is too large for ",
                                 component.is_closed() ? "a closed" : "an open", " part of area ",
                                 component.area, "; it can hold at most ", largest));
    }
    const double length = component.box.longest_side();
    const double largest_along = longest_edge_along(component.area, length);
    if (target > largest_along) {
      const auto first_face = std::ranges::find(components.of_face, static_cast<int>(i));
      throw InvalidOption(
          concat("remesh: the part with face ", first_face - components.of_face.begin(), " is ",
                 length, " long and too narrow for edges of ", target,
                 "; remove vertices that lie far off, or use edges of at most ", largest_along));
    }
  }
  const double smallest = std::sqrt(area / most_faces / area_of_equilateral);
  if (target < smallest) {
    throw InvalidOption(concat("remesh: a target edge length of ", target, " on an area of ", area,
                               " makes more than ", most_faces, " faces; use at least ", smallest));
  }
}

/// How m_i approaches m [Pecanha2013, Algorithm 1], and what the stellar operations of iteration i
/// change.
///
/// m_i = min(m, 2 · average) keeps an iteration from changing the mesh violently. On top of it m_i
/// rises softly towards m, which the paper recommends for difficult models: edges keep falling out
/// of the range, and the operations on them anneal irregular vertices that would be frozen in
/// otherwise (1 to 2 % more regular vertices). Aiming below m by as much as the mean is above it
/// keeps the mean within 2 % of m; left alone it settles up to 4 % above, since long edges are
/// halved while short ones merely vanish.
StellarLimits limits_of_iteration(const TriMesh& mesh, const RemeshOptions& options, int i) {
  constexpr double first_target = 0.9;  // m_1 / m
  constexpr double largest_correction = 0.1;
  constexpr double overlong = 2.5;      // in σ: the next round would split such an edge again
  constexpr double mending_part = 0.9;  // the last iterations only settle what was mended
  const double progress = options.iterations == 1 ? 1.0 : (i - 1.0) / (options.iterations - 1.0);
  const double goal = (first_target + (1.0 - first_target) * progress) * options.target_edge_length;
  const double average = mean_edge_length(mesh);
  const double corrected =
      goal * std::clamp(goal / average, 1.0 - largest_correction, 1.0 + largest_correction);
  const double target = std::min(corrected, 2.0 * average);
  const double sigma = options.tolerance * target;
  return {.target = target,
          .shortest = target - sigma,
          .longest = target + sigma,
          .overlong = target + overlong * sigma,
          .mends_valences = i <= mending_part * options.iterations};
}

/// Whether splitting the long edges alone would make a mesh far larger than the net: it consists of
/// needles, which must be joined first.
bool consists_of_needles(const TriMesh& mesh, double target) {
  constexpr double max_faces = 50.0;  // times those of the net
  double pieces = 0.0;
  for (const auto e : mesh.edges()) pieces += mesh.calc_edge_length(e) / target;
  return pieces * target * target > max_faces * surface_area(mesh) / area_of_equilateral;
}

/// Joins needles side by side, by collapses of their short edges.
void join_needles(ConstrainedMesh& constrained, const StellarLimits& limits) {
  constexpr int max_rounds = 50;  // each about halves their number
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const StellarLimits collapses_only = {.target = limits.target,
                                        .shortest = limits.shortest,
                                        .longest = infinity,
                                        .overlong = infinity,
                                        .mends_valences = false};
  for (int round = 0; round < max_rounds; ++round) {
    if (apply_stellar_operations(constrained, collapses_only) == 0) return;
  }
}

/// One round of stellar operations and flips; more of them while the mean edge length is far from
/// the target and comes nearer, so that a few iterations reach a target far from the input.
void change_edges(ConstrainedMesh& constrained, const StellarLimits& limits) {
  constexpr double far = 0.33;             // of the target
  constexpr double least_progress = 0.02;  // of the target, per round
  double distance = std::numeric_limits<double>::max();
  double before = distance;
  do {
    apply_stellar_operations(constrained, limits);
    correct_valences(constrained);
    before = distance;
    distance = std::abs(mean_edge_length(constrained.mesh) - limits.target);
  } while (distance > far * limits.target && distance < before - least_progress * limits.target);
}

/// Whether faces around one of its ends meet at a crease.
bool ends_at_crease(const TriMesh& mesh, EdgeHandle e) {
  constexpr double sharp = 40.0 * std::numbers::pi / 180.0;
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  return std::ranges::any_of(
      std::array{mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)}, [&](VertexHandle v) {
        return std::ranges::any_of(mesh.ve_range(v), [&](EdgeHandle other) {
          return !mesh.is_boundary(other) && std::abs(mesh.calc_dihedral_angle(other)) > sharp;
        });
      });
}

/// Whether both faces of an edge are needles along it: too narrow to hold an edge of the net, so
/// that their normals are right as they are, while dividing them makes many faces.
bool lies_between_needles(const TriMesh& mesh, EdgeHandle e, double target) {
  constexpr double min_width = 0.05;  // in target lengths
  const double length = mesh.calc_edge_length(e);
  for (const HalfedgeHandle h : {mesh.halfedge_handle(e, 0), mesh.halfedge_handle(e, 1)}) {
    if (mesh.is_boundary(h)) continue;
    const double width = 2.0 * mesh.calc_face_area(mesh.face_handle(h)) / length;
    if (width > min_width * target) return false;
  }
  return true;
}

/// Up to here everything stays in the processor's cache, whatever the order.
constexpr std::size_t small_mesh = 20000;  // vertices

bool differs_by_a_tenth(std::size_t vertices, std::size_t before) {
  return 10 * (std::max(vertices, before) - std::min(vertices, before)) > before;
}

}  // namespace

RemeshProgress measure_progress(const TriMesh& mesh) {
  RemeshProgress progress;
  // Counted, since a mesh may hold deleted elements while it is changed.
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const auto e : mesh.edges()) {
    const double length = mesh.calc_edge_length(e);
    count += 1.0;
    sum += length;
    squares += length * length;
  }
  progress.mean_edge_length = sum / count;
  const double variance = squares / count - progress.mean_edge_length * progress.mean_edge_length;
  progress.relative_spread = std::sqrt(std::max(variance, 0.0)) / progress.mean_edge_length;
  int interior = 0;
  int regular = 0;
  for (const auto v : mesh.vertices()) {
    ++progress.vertices;
    if (v.is_boundary()) continue;
    ++interior;
    if (v.valence() == 6) ++regular;
  }
  progress.regular_fraction = interior == 0 ? 0.0 : static_cast<double>(regular) / interior;
  return progress;
}

void check_remeshable(const TriMesh& mesh, const RemeshOptions& options) {
  check_options(mesh, options);
  check_that_target_fits(mesh, options.target_edge_length);
}

TriMesh with_edges_divided(const TriMesh& surface, double target) {
  constexpr double longest = 3.0;         // in target lengths
  constexpr double most_of_net = 2.0;     // faces, times those of the net
  constexpr double most_of_input = 16.0;  // faces, times those of the surface
  TriMesh divided = surface;
  const double most_faces =
      most_of_input * static_cast<double>(surface.n_faces()) +
      most_of_net * surface_area(surface) / (area_of_equilateral * target * target);
  // The longest first; of equal ones the one with the lower index.
  std::priority_queue<std::pair<double, int>> queue;
  const auto add = [&](EdgeHandle e) {
    const double length = divided.calc_edge_length(e);
    if (length > longest * target && ends_at_crease(divided, e) &&
        !lies_between_needles(divided, e, target)) {
      queue.emplace(length, -e.idx());
    }
  };
  for (const auto e : divided.edges()) add(e);
  while (!queue.empty() && static_cast<double>(divided.n_faces()) < most_faces) {
    const auto [length, minus_index] = queue.top();
    queue.pop();
    const EdgeHandle e(-minus_index);
    if (divided.calc_edge_length(e) != length) continue;  // halved meanwhile
    const HalfedgeHandle h = divided.halfedge_handle(e, 0);
    const Eigen::Vector3d middle = 0.5 * (divided.point(divided.from_vertex_handle(h)) +
                                          divided.point(divided.to_vertex_handle(h)));
    const VertexHandle v = divided.split(e, middle);
    for (const auto spoke : divided.ve_range(v)) add(spoke);
  }
  return divided;
}

void remesh_in_place(ConstrainedMesh& constrained, const RemeshOptions& options,
                     const std::function<void(const RemeshProgress&)>& after_iteration) {
  if (consists_of_needles(constrained.mesh, options.target_edge_length)) {
    join_needles(constrained, limits_of_iteration(constrained.mesh, options, 1));
  }
  std::size_t numbered = 0;  // vertices when they were last numbered
  for (int i = 1; i <= options.iterations; ++i) {
    const std::size_t vertices = constrained.mesh.n_vertices();
    if (i > 1 && vertices > small_mesh &&
        (numbered == 0 || differs_by_a_tenth(vertices, numbered))) {
      constrained.renumber();
      numbered = vertices;
    }
    change_edges(constrained, limits_of_iteration(constrained.mesh, options, i));
    slide_vertices(constrained,
                   relaxed_positions(constrained, {options.rings, options.restriction}));

    RemeshProgress progress = measure_progress(constrained.mesh);
    progress.iteration = i;
    progress.iterations = options.iterations;
    after_iteration(progress);
  }
}

RemeshResult remesh(const TriMesh& mesh, const RemeshOptions& options) {
  check_remeshable(mesh, options);
  RemeshResult result;
  result.mesh = with_edges_divided(mesh, options.target_edge_length);
  ConstrainedMesh constrained(result.mesh, find_creases(result.mesh, options.feature_angle));
  remesh_in_place(constrained, options, [&](const RemeshProgress& progress) {
    result.iterations = progress.iteration;
    result.relative_spread = progress.relative_spread;
    result.regular_fraction = progress.regular_fraction;
    if (options.on_progress) options.on_progress(progress);
  });
  return result;
}

}  // namespace trivalent::remesh
