#include "equalize/stellar.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "equalize/face_guard.h"
#include "equalize/valence.h"

namespace trivalent::remesh {

namespace {

struct Candidate {
  EdgeHandle edge;
  double deviation = 0.0;  ///< | |a| - m_i |
};

int squared(int deviation) { return deviation * deviation; }

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
  return mesh.calc_edge_length(e) < target ? collapse_mends_valences(d) : split_mends_valences(d);
}

/// [Pecanha2013, Algorithm 2]
std::vector<Candidate> priority_list(const TriMesh& mesh, const StellarLimits& limits) {
  const std::vector<int> deviations =
      limits.mends_valences ? valence_deviations(mesh) : std::vector<int>();
  std::vector<Candidate> list;
  for (const auto e : mesh.edges()) {
    const double length = mesh.calc_edge_length(e);
    const bool out_of_range = length > limits.longest || length < limits.shortest;
    const bool is_mended = !out_of_range && limits.mends_valences &&
                           mends_valences(mesh, e, deviations, limits.target);
    if (out_of_range || is_mended) list.push_back({e, std::abs(length - limits.target)});
  }
  // Ties keep their order, so that the result is the same everywhere.
  std::ranges::stable_sort(list, std::greater(), &Candidate::deviation);
  return list;
}

/// The vertex that a collapse removes, the one that stays, and where that one goes.
struct Collapse {
  HalfedgeHandle halfedge;  ///< from the removed vertex to the kept one
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Anchor anchor;  ///< of the kept vertex afterwards
};

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
      const bool is_long = mesh_.calc_edge_length(e) > limits_.target;
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
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
    const VertexHandle from = mesh_.from_vertex_handle(h);
    const VertexHandle to = mesh_.to_vertex_handle(h);
    const std::optional<int> curve = constrained_.curve_of(e);
    const Eigen::Vector3d midpoint = 0.5 * (mesh_.point(from) + mesh_.point(to));
    Anchor anchor;
    anchor.face = constrained_.anchor(from).face;
    if (curve) {
      anchor.kind = FeatureKind::curve;
      anchor.on_curve = constrained_.curves().nearest(midpoint, *curve);
    }
    const VertexHandle v = mesh_.split(e, midpoint);
    // The midpoint itself turns no face over; the projected point is taken only if it does not
    // either.
    const Eigen::Vector3d projected = constrained_.project(midpoint, anchor);
    if (faces_stay_upright(mesh_, v, projected)) mesh_.point(v) = projected;
    constrained_.set_anchor(v, anchor);
    for (const auto spoke : mesh_.ve_range(v)) constrained_.set_curve(spoke, std::nullopt);
    for (const VertexHandle end : {from, to}) {
      constrained_.set_curve(mesh_.edge_handle(mesh_.find_halfedge(v, end)), curve);
    }
    lock_star(v);
    return true;
  }

  /// The collapse of e that respects the features, if there is one.
  [[nodiscard]] std::optional<Collapse> plan_collapse(EdgeHandle e) const {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
    const VertexHandle from = mesh_.from_vertex_handle(h);
    const VertexHandle to = mesh_.to_vertex_handle(h);
    const Anchor& a = constrained_.anchor(from);
    const Anchor& b = constrained_.anchor(to);
    const bool along_curve = constrained_.curve_of(e).has_value();
    if (a.kind != FeatureKind::none && b.kind != FeatureKind::none && !along_curve)
      return std::nullopt;
    if (a.kind == FeatureKind::corner && b.kind == FeatureKind::corner) return std::nullopt;
    if (a.kind != b.kind) {  // the freer vertex goes
      const bool from_goes = a.kind < b.kind;
      const VertexHandle kept = from_goes ? to : from;
      return Collapse{from_goes ? h : mesh_.opposite_halfedge_handle(h), mesh_.point(kept),
                      constrained_.anchor(kept)};
    }
    Collapse plan{h, Eigen::Vector3d::Zero(), b};
    plan.position = constrained_.project(0.5 * (mesh_.point(from) + mesh_.point(to)), plan.anchor);
    return plan;
  }

  bool collapse(EdgeHandle e) {
    const std::optional<Collapse> plan = plan_collapse(e);
    if (!plan || !mesh_.is_collapse_ok(plan->halfedge) || !keeps_curves(plan->halfedge))
      return false;
    const VertexHandle removed = mesh_.from_vertex_handle(plan->halfedge);
    const VertexHandle kept = mesh_.to_vertex_handle(plan->halfedge);
    if (!keeps_valences(plan->halfedge) || makes_overlong_edge(*plan)) return false;
    if (!faces_stay_upright(mesh_, removed, plan->position, kept) ||
        !faces_stay_upright(mesh_, kept, plan->position, removed)) {
      return false;
    }
    const auto curve_edges = curve_edges_of(removed, kept);
    mesh_.collapse(plan->halfedge);
    mesh_.point(kept) = plan->position;
    constrained_.set_anchor(kept, plan->anchor);
    for (const auto& [neighbor, curve] : curve_edges) {
      constrained_.set_curve(mesh_.edge_handle(mesh_.find_halfedge(kept, neighbor)), curve);
    }
    lock_star(kept);
    return true;
  }

  /// Merging two sides of a triangle that both lie on curves would close the curve onto itself.
  [[nodiscard]] bool keeps_curves(HalfedgeHandle h) const {
    for (const HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
      if (mesh_.is_boundary(side)) continue;
      const HalfedgeHandle next = mesh_.next_halfedge_handle(side);
      const HalfedgeHandle previous = mesh_.prev_halfedge_handle(side);
      if (constrained_.curve_of(mesh_.edge_handle(next)) &&
          constrained_.curve_of(mesh_.edge_handle(previous))) {
        return false;
      }
    }
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
        if ((mesh_.point(neighbor) - plan.position).norm() > limits_.overlong) return true;
      }
    }
    return false;
  }

  /// Curve edges at v and their other ends, but for the one to `except`.
  [[nodiscard]] std::vector<std::pair<VertexHandle, int>> curve_edges_of(
      VertexHandle v, VertexHandle except) const {
    std::vector<std::pair<VertexHandle, int>> edges;
    for (const auto h : mesh_.voh_range(v)) {
      const std::optional<int> curve = constrained_.curve_of(mesh_.edge_handle(h));
      if (curve && mesh_.to_vertex_handle(h) != except)
        edges.emplace_back(mesh_.to_vertex_handle(h), *curve);
    }
    return edges;
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

}  // namespace trivalent::remesh
