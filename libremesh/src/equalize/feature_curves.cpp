#include "equalize/feature_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// A curve that turns by more than this at a vertex has a corner there [rad].
constexpr double corner_turn = std::numbers::pi / 4.0;

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// @return  Of its images, in a lattice, that beside p.
Eigen::Vector3d nearest_on_segment(const Lattice& lattice, const Eigen::Vector3d& p,
                                   const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Vector3d a = lattice.near(p, from);
  const Eigen::Vector3d ab = to - from;
  const double squared = ab.squaredNorm();
  if (squared == 0.0) return a;
  return a + std::clamp((p - a).dot(ab) / squared, 0.0, 1.0) * ab;
}

}  // namespace

Creases find_creases(const TriMesh& surface, std::optional<double> feature_angle) {
  if (!feature_angle) return {};
  Creases creases(surface.n_edges(), false);
  for (const auto e : surface.edges()) {
    if (e.is_boundary()) continue;
    const Eigen::Vector3d left = face_normal(surface, e.h0().face());
    const Eigen::Vector3d right = face_normal(surface, e.h1().face());
    creases[static_cast<std::size_t>(e.idx())] = angle_between(left, right) > *feature_angle;
  }
  return creases;
}

FeatureCurves::FeatureCurves(const TriMesh& surface, const Creases& creases)
    : lattice_(surface.lattice),
      is_feature_(creases),
      curve_of_(surface.n_edges()),
      kinds_(surface.n_vertices(), FeatureKind::none),
      places_(surface.n_vertices()) {
  is_feature_.resize(surface.n_edges(), false);
  for (const auto e : surface.edges()) {
    if (e.is_boundary()) is_feature_[index(e)] = true;
  }
  find_corners(surface);
  trace_curves(surface);
  find_boundaries(surface);
}

void FeatureCurves::find_corners(const TriMesh& surface) {
  for (const auto v : surface.vertices()) {
    std::vector<Eigen::Vector3d> along;
    for (const auto h : v.outgoing_halfedges()) {
      if (is_feature_[index(h.edge())]) along.push_back(edge_vector(surface, h));
    }
    if (along.empty()) continue;
    const bool turns = along.size() == 2 && angle_between(along[0], -along[1]) > corner_turn;
    kinds_[index(v)] = along.size() != 2 || turns ? FeatureKind::corner : FeatureKind::curve;
  }
}

void FeatureCurves::trace_curves(const TriMesh& surface) {
  const auto trace_from = [&](FeatureKind kind) {
    for (const auto v : surface.vertices()) {
      if (kinds_[index(v)] != kind) continue;
      for (const auto h : v.outgoing_halfedges()) {
        if (is_feature_[index(h.edge())] && !curve_of_[index(h.edge())]) trace(surface, h);
      }
    }
  };
  trace_from(FeatureKind::corner);  // curves between corners
  trace_from(FeatureKind::curve);   // what is left are loops without a corner
}

void FeatureCurves::trace(const TriMesh& surface, HalfedgeHandle first) {
  const int curve = static_cast<int>(curves_.size());
  const VertexHandle start = surface.from_vertex_handle(first);
  Curve polyline{{surface.point(start)}, false};
  HalfedgeHandle h = first;
  while (h.is_valid()) {
    curve_of_[index(surface.edge_handle(h))] = curve;
    const VertexHandle v = surface.to_vertex_handle(h);
    const Eigen::Vector3d& last = polyline.points.back();
    polyline.points.push_back(surface.lattice.near(last, surface.point(v)));
    h = HalfedgeHandle();
    if (kinds_[index(v)] == FeatureKind::corner) break;
    const int segment = static_cast<int>(polyline.points.size()) - 2;
    places_[index(v)] = {curve, segment, surface.point(v)};
    polyline.closed = v == start;
    for (const auto next : surface.voh_range(v)) {
      const EdgeHandle e = surface.edge_handle(next);
      if (is_feature_[index(e)] && !curve_of_[index(e)]) h = next;
    }
  }
  curves_.push_back(std::move(polyline));
}

void FeatureCurves::find_boundaries(const TriMesh& surface) {
  boundary_of_.resize(curves_.size());
  for (const std::vector<VertexHandle>& loop : boundary_loops(surface)) {
    Boundary boundary;
    for (const VertexHandle v : loop) {
      const EdgeHandle e = surface.edge_handle(surface.halfedge_handle(v));
      boundary_of_[static_cast<std::size_t>(*curve_of_[index(e)])] =
          static_cast<int>(boundaries_.size());
      if (const auto tube = tube_end(surface, v)) boundary.tube = tube;
      boundary.turn += std::numbers::pi;
      for (const auto h : surface.voh_range(v)) {
        if (h.is_boundary()) continue;
        boundary.turn -= angle_between(edge_vector(surface, h), -edge_vector(surface, h.prev()));
      }
    }
    boundaries_.push_back(boundary);
  }
}

CurvePoint FeatureCurves::nearest(const Eigen::Vector3d& p, const CurvePoint& near) const {
  const Curve& curve = curves_[static_cast<std::size_t>(near.curve)];
  const int segments = static_cast<int>(curve.points.size()) - 1;
  const double reach = 2.0 * lattice_.nearest(p - near.position).norm();
  CurvePoint best = near;
  double best_distance = std::numeric_limits<double>::max();
  const auto try_segment = [&](int s) {
    const auto i = static_cast<std::size_t>(s);
    const Eigen::Vector3d foot =
        nearest_on_segment(lattice_, p, curve.points[i], curve.points[i + 1]);
    const double distance = (p - foot).norm();
    if (distance < best_distance) {
      best = {near.curve, s, foot};
      best_distance = distance;
    }
  };
  try_segment(near.segment);
  for (const int direction : {1, -1}) {
    double walked = 0.0;  // from the near segment to the one at hand
    int s = near.segment;
    for (int steps = 1; steps < segments && walked <= reach; ++steps) {
      s += direction;
      if (curve.closed) s = (s + segments) % segments;
      if (s < 0 || s >= segments) break;
      try_segment(s);
      const auto i = static_cast<std::size_t>(s);
      walked += (curve.points[i + 1] - curve.points[i]).norm();
    }
  }
  return best;
}

CurvePoint FeatureCurves::nearest(const Eigen::Vector3d& p, int curve) const {
  const Curve& whole = curves_[static_cast<std::size_t>(curve)];
  CurvePoint best;
  double best_distance = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i + 1 < whole.points.size(); ++i) {
    const Eigen::Vector3d foot =
        nearest_on_segment(lattice_, p, whole.points[i], whole.points[i + 1]);
    if ((p - foot).norm() >= best_distance) continue;
    best = {curve, static_cast<int>(i), foot};
    best_distance = (p - foot).norm();
  }
  return best;
}

double FeatureCurves::length(int curve) const {
  const std::vector<Eigen::Vector3d>& points = curves_[static_cast<std::size_t>(curve)].points;
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

Eigen::Vector3d FeatureCurves::tangent(const CurvePoint& p) const {
  const Curve& curve = curves_[static_cast<std::size_t>(p.curve)];
  const auto i = static_cast<std::size_t>(p.segment);
  return (curve.points[i + 1] - curve.points[i]).normalized();
}

}  // namespace trivalent::remesh
