#include "equalize/stellar.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "equalize/face_guard.h"
#include "equalize/valence.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

struct Candidate {
  EdgeHandle edge;
  double deviation = 0.0;  ///< | |a| - m_i |
};

/// Valence deviations of v1 to v4 around an edge.
using Deviations = std::array<int, 4>;

/// A collapse merges v1 and v3 into a vertex of valence v1 + v3 - 4 and takes an edge from v2 and
/// v4.
bool collapse_mends_valences(const Deviations& d) {
  return squared(d[0] + d[2] + 2) + squared(d[1] - 1) + squared(d[3] - 1) <
         squared(d[0]) + squared(d[1]) + squared(d[2]) + squared(d[3]);
}

/// A split makes a vertex of valence 4 and gives an edge to v2 and v4.
bool split_mends_valences(const Deviations& d) {
  return squared(4 - 6) + squared(d[1] + 1) + squared(d[3] + 1) < squared(d[1]) + squared(d[3]);
}

/// An edge within the limits whose operation mends valences: collapse below the target, split
/// above.
bool mends_valences(const TriMesh& mesh, EdgeHandle e, const std::vector<int>& deviations,
                    double target) {
  if (mesh.is_boundary(e)) return false;
  const auto [v1, v2, v3, v4] = neighborhood_of(mesh, e);
  for (const VertexHandle v : {v1, v2, v3, v4}) {
    if (mesh.is_boundary(v)) return false;
  }
  const Deviations d = {deviations[index(v1)], deviations[index(v2)], deviations[index(v3)],
                        deviations[index(v4)]};
  return edge_length(mesh, e) < target ? collapse_mends_valences(d) : split_mends_valences(d);
}

/// [Pecanha2013, Algorithm 2]
std::vector<Candidate> priority_list(const TriMesh& mesh, const StellarLimits& limits) {
  const std::vector<int> deviations =
      limits.mends_valences ? valence_deviations(mesh) : std::vector<int>();
  std::vector<Candidate> list;
  for (const auto e : mesh.edges()) {
    const double length = edge_length(mesh, e);
    const bool out_of_range = length > limits.longest || length < limits.shortest;
    const bool is_mended = !out_of_range && limits.mends_valences &&
                           mends_valences(mesh, e, deviations, limits.target);
    if (out_of_range || is_mended) list.push_back({e, std::abs(length - limits.target)});
  }
  // Ties keep their order, so that the result is the same everywhere.
  std::ranges::stable_sort(list, std::greater(), &Candidate::deviation);
  return list;
}

class StellarRound {
 public:
  StellarRound(ConstrainedMesh& constrained, const StellarLimits& limits)
      : constrained_(constrained),
        mesh_(constrained.mesh),
        limits_(limits),
        locked_(mesh_.n_vertices(), false) {}

  int run() {
    int changed = 0;
    for (const Candidate& candidate : priority_list(mesh_, limits_)) {
      const EdgeHandle e = candidate.edge;
      if (mesh_.status(e).deleted() || is_locked(e)) continue;
      const bool is_long = edge_length(mesh_, e) > limits_.target;
      if (is_long ? split(e) : collapse(e)) ++changed;
    }
    mesh_.garbage_collection();
    return changed;
  }

 private:
  [[nodiscard]] bool is_locked(EdgeHandle e) const {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
    return locked_[index(mesh_.from_vertex_handle(h))] || locked_[index(mesh_.to_vertex_handle(h))];
  }

  void lock_star(VertexHandle v) {
    locked_.resize(mesh_.n_vertices(), false);
    locked_[index(v)] = true;
    for (const auto neighbor : mesh_.vv_range(v)) locked_[index(neighbor)] = true;
  }

  bool split(EdgeHandle e) {
    lock_star(constrained_.split(e));
    return true;
  }

  bool collapse(EdgeHandle e) {
    const std::optional<Collapse> plan = constrained_.plan_collapse(e);
    if (!plan || !keeps_valences(plan->halfedge) || makes_overlong_edge(*plan)) return false;
    const VertexHandle removed = mesh_.from_vertex_handle(plan->halfedge);
    const VertexHandle kept = mesh_.to_vertex_handle(plan->halfedge);
    if (!faces_stay_upright(mesh_, removed, plan->position, kept) ||
        !faces_stay_upright(mesh_, kept, plan->position, removed)) {
      return false;
    }
    constrained_.collapse(*plan);
    lock_star(kept);
    return true;
  }

  /// A collapse takes one edge from each vertex opposite to it; rings need three atoms.
  [[nodiscard]] bool keeps_valences(HalfedgeHandle h) const {
    for (const HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
      if (mesh_.is_boundary(side)) continue;
      const VertexHandle opposite = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side));
      if (!mesh_.is_boundary(opposite) && mesh_.valence(opposite) <= 4) return false;
    }
    return true;
  }

  /// An edge that the next round would split again is not worth making.
  [[nodiscard]] bool makes_overlong_edge(const Collapse& plan) const {
    for (const VertexHandle end :
         {mesh_.from_vertex_handle(plan.halfedge), mesh_.to_vertex_handle(plan.halfedge)}) {
      for (const auto neighbor : mesh_.vv_range(end)) {
        const Eigen::Vector3d edge = mesh_.lattice.nearest(mesh_.point(neighbor) - plan.position);
        if (edge.norm() > limits_.overlong) return true;
      }
    }
    return false;
  }

  ConstrainedMesh& constrained_;
  TriMesh& mesh_;
  StellarLimits limits_;
  std::vector<bool> locked_;
};

}  // namespace

int apply_stellar_operations(ConstrainedMesh& constrained, const StellarLimits& limits) {
  return StellarRound(constrained, limits).run();
}

void split_edges_longer_than(ConstrainedMesh& constrained, double length) {
  std::vector<std::pair<double, EdgeHandle>> list;
  for (const auto e : constrained.mesh.edges()) {
    const double longer = edge_length(constrained.mesh, e);
    if (longer > length) list.emplace_back(longer, e);
  }
  std::ranges::stable_sort(list, std::greater(), [](const auto& entry) { return entry.first; });
  for (const auto& [longer, e] : list) constrained.split(e);
}

}  // namespace trivalent::remesh
