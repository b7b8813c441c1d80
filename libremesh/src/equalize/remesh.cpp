#include "trivalent/remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equalize/constrained_mesh.h"
#include "equalize/paper_loop.h"
#include "equalize/relaxation.h"
#include "equalize/sliding.h"
#include "equalize/stellar.h"
#include "equalize/valence.h"
#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

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
  for (const auto e : mesh.edges()) pieces += edge_length(mesh, e) / target;
  return pieces * target * target > max_faces * surface_area(mesh) / unit_triangle_area;
}

bool should_stop(const RemeshOptions& options) {
  return options.should_stop && options.should_stop();
}

/// Joins needles side by side, by collapses of their short edges that make none of `overlong`.
void join_needles(ConstrainedMesh& constrained, const RemeshOptions& options, double overlong) {
  const StellarLimits limits = limits_of_iteration(constrained.mesh, options, 1);
  constexpr int max_rounds = 50;  // each about halves their number
  const StellarLimits collapses_only = {.target = limits.target,
                                        .shortest = limits.shortest,
                                        .longest = std::numeric_limits<double>::infinity(),
                                        .overlong = overlong,
                                        .mends_valences = false};
  for (int round = 0; round < max_rounds; ++round) {
    if (should_stop(options) || apply_stellar_operations(constrained, collapses_only) == 0) return;
  }
}

double longest_edge_length(const TriMesh& mesh) {
  double longest = 0.0;
  for (const auto e : mesh.edges()) longest = std::max(longest, edge_length(mesh, e));
  return longest;
}

/// Halves edges far longer than the target, and joins what is then too narrow.
void divide_far_edges(ConstrainedMesh& constrained, const RemeshOptions& options) {
  constexpr double far = 4.0;  // times the target
  const double length = far * options.target_edge_length;
  // Flips may make some long again, so that the last of them are left to the loop.
  const double longest = longest_edge_length(constrained.mesh);
  const int rounds = static_cast<int>(std::ceil(std::log2(std::max(longest / length, 1.0))));
  for (int round = 0; round < rounds && !should_stop(options); ++round) {
    split_edges_longer_than(constrained, length);
    correct_valences(constrained);
    join_needles(constrained, options, longest_edge_length(constrained.mesh));
  }
}

/// One round of stellar operations and flips; more of them while the mean edge length is far from
/// the target and comes nearer, so that a few iterations reach a target far from the input.
void change_edges(ConstrainedMesh& constrained, const RemeshOptions& options, int iteration) {
  const StellarLimits limits = limits_of_iteration(constrained.mesh, options, iteration);
  constexpr double far = 0.33;           // of the target
  constexpr double min_progress = 0.02;  // of the target, per round
  double distance = std::numeric_limits<double>::max();
  while (true) {
    apply_stellar_operations(constrained, limits);
    correct_valences(constrained);
    const double before =
        std::exchange(distance, std::abs(mean_edge_length(constrained.mesh) - limits.target));
    const bool is_near = distance <= far * limits.target;
    const bool has_stalled = distance >= before - min_progress * limits.target;
    if (is_near || has_stalled || should_stop(options)) return;
  }
}

/// Up to here everything stays in the processor's cache, whatever the order.
constexpr std::size_t small_mesh = 20000;  // vertices

bool differs_by_a_tenth(std::size_t vertices, std::size_t before) {
  return 10 * (std::max(vertices, before) - std::min(vertices, before)) > before;
}

}  // namespace

bool remesh_in_place(ConstrainedMesh& constrained, const RemeshOptions& options,
                     const std::function<void(const RemeshProgress&)>& after_iteration) {
  if (consists_of_needles(constrained.mesh, options.target_edge_length)) {
    join_needles(constrained, options, std::numeric_limits<double>::infinity());
  }
  divide_far_edges(constrained, options);
  std::size_t numbered = 0;  // vertices when they were last numbered
  for (int i = 1; i <= options.iterations; ++i) {
    if (should_stop(options)) return false;
    const std::size_t vertices = constrained.mesh.n_vertices();
    if (i > 1 && vertices > small_mesh &&
        (numbered == 0 || differs_by_a_tenth(vertices, numbered))) {
      constrained.renumber();
      numbered = vertices;
    }
    change_edges(constrained, options, i);
    if (should_stop(options)) return false;
    slide_vertices(constrained,
                   relaxed_positions(constrained, {options.rings, options.restriction}));

    RemeshProgress progress = measure_progress(constrained.mesh);
    progress.iteration = i;
    progress.iterations = options.iterations;
    after_iteration(progress);
  }
  return true;
}

RemeshResult remesh(const TriMesh& mesh, const RemeshOptions& options) {
  check_remeshable(mesh, options);
  RemeshResult result;
  result.mesh = with_edges_divided(mesh, options.target_edge_length);
  ConstrainedMesh constrained(result.mesh, find_creases(result.mesh, options.feature_angle));
  const bool is_done = remesh_in_place(constrained, options, [&](const RemeshProgress& progress) {
    result.iterations = progress.iteration;
    if (options.on_progress) options.on_progress(progress);
  });
  if (result.iterations == 0) throw Stopped("remesh: stopped before there was a net");
  const RemeshProgress state = measure_progress(result.mesh);
  result.relative_spread = state.relative_spread;
  result.regular_fraction = state.regular_fraction;
  result.stopped = !is_done;
  return result;
}

}  // namespace trivalent::remesh
