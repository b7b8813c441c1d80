#include "equalize/constrained_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Interleaves the lowest 21 bits of three numbers (Morton order).
std::uint64_t interleaved(const Eigen::Array3d& cell) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto bits = static_cast<std::uint64_t>(cell[axis]);
    for (int bit = 0; bit < 21; ++bit) code |= (bits >> bit & 1U) << (3 * bit + axis);
  }
  return code;
}

std::vector<VertexHandle> along_space_filling_curve(const TriMesh& mesh) {
  constexpr double cells = 2097151.0;  // 2^21 - 1 along the longest side
  const BoundingBox box = bounding_box(mesh);
  const double scale = box.longest_side() > 0.0 ? cells / box.longest_side() : 0.0;
  std::vector<std::pair<std::uint64_t, VertexHandle>> places;
  places.reserve(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    places.emplace_back(interleaved((mesh.point(v) - box.low).array() * scale), v);
  }
  std::sort(places.begin(), places.end());
  std::vector<VertexHandle> order;
  order.reserve(places.size());
  for (const auto& [code, v] : places) order.push_back(v);
  return order;
}

}  // namespace

ConstrainedMesh::ConstrainedMesh(TriMesh& original, const Creases& creases)
    : mesh(original),
      surface_(std::make_shared<const SurfaceProjector>(original)),
      curves_(original, creases),
      anchors_(original),
      curve_of_(original) {
  for (const auto e : mesh.edges()) curve_of_[e] = curves_.curve_of(e);
  for (const auto v : mesh.vertices()) {
    Anchor& anchor = anchors_[v];
    anchor.kind = curves_.kind(v);
    if (anchor.kind == FeatureKind::curve) anchor.on_curve = curves_.at(v);
    for (const auto f : v.faces()) anchor.face = f.idx();
  }
}

ConstrainedMesh::ConstrainedMesh(TriMesh& net, const ConstrainedMesh& other, const State& state)
    : mesh(net), surface_(other.surface_), curves_(other.curves_), anchors_(net), curve_of_(net) {
  mesh.lattice = other.mesh.lattice;
  restore(state);
}

ConstrainedMesh::State ConstrainedMesh::state() const {
  State state;
  for (const auto v : mesh.vertices()) {
    state.positions.push_back(mesh.point(v));
    state.anchors.push_back(anchors_[v]);
  }
  state.triangles = triangles_of(mesh);
  for (const auto e : mesh.edges()) {
    if (curve_of_[e]) state.curve_edges.push_back({e.v0(), e.v1(), *curve_of_[e]});
  }
  return state;
}

void ConstrainedMesh::restore(const State& state) {
  mesh.clean_keep_reservation();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    anchors_[mesh.add_vertex(state.positions[i])] = state.anchors[i];
  }
  for (const auto& [a, b, c] : state.triangles) {
    mesh.add_face(VertexHandle(a), VertexHandle(b), VertexHandle(c));
  }
  for (const auto e : mesh.edges()) curve_of_[e] = std::nullopt;
  for (const CurveEdge& e : state.curve_edges) {
    curve_of_[mesh.edge_handle(mesh.find_halfedge(e.from, e.to))] = e.curve;
  }
}

void ConstrainedMesh::renumber() {
  const std::vector<VertexHandle> order = along_space_filling_curve(mesh);
  State state = this->state();
  std::vector<int> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[index(order[i])] = static_cast<int>(i);
    state.positions[i] = mesh.point(order[i]);
    state.anchors[i] = anchors_[order[i]];
  }
  for (auto& triangle : state.triangles) {
    for (int& v : triangle) v = number[static_cast<std::size_t>(v)];
  }
  std::ranges::sort(state.triangles, {}, [](const auto& t) { return std::ranges::min(t); });
  for (CurveEdge& e : state.curve_edges) {
    e.from = VertexHandle(number[index(e.from)]);
    e.to = VertexHandle(number[index(e.to)]);
  }
  restore(state);
}

void ConstrainedMesh::subdivide() {
  State fine;
  for (const auto v : mesh.vertices()) {
    fine.positions.push_back(mesh.point(v));
    fine.anchors.push_back(anchors_[v]);
  }
  std::vector<int> midpoint_of(mesh.n_edges());
  for (const auto e : mesh.edges()) {
    const Eigen::Vector3d middle = midpoint(mesh, e.v0(), e.v1());
    Anchor anchor;
    anchor.face = anchors_[e.v0()].face;
    const VertexHandle v(static_cast<int>(fine.positions.size()));
    if (const std::optional<int> curve = curve_of_[e]) {
      anchor.kind = FeatureKind::curve;
      anchor.on_curve = curves_.nearest(middle, *curve);
      fine.curve_edges.push_back({e.v0(), v, *curve});
      fine.curve_edges.push_back({v, e.v1(), *curve});
    }
    midpoint_of[static_cast<std::size_t>(e.idx())] = v.idx();
    fine.positions.push_back(anchor.kind == FeatureKind::curve
                                 ? project(middle, anchor)
                                 : project_between(e.v0(), e.v1(), middle, anchor));
    fine.anchors.push_back(anchor);
  }
  fine.triangles.reserve(4 * mesh.n_faces());
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corner{};
    std::array<int, 3> middle{};  // of the edge from corner k to the next
    std::size_t k = 0;
    for (const auto h : mesh.fh_range(f)) {
      corner[k] = mesh.from_vertex_handle(h).idx();
      middle[k] = midpoint_of[static_cast<std::size_t>(mesh.edge_handle(h).idx())];
      ++k;
    }
    for (k = 0; k < 3; ++k) fine.triangles.push_back({corner[k], middle[k], middle[(k + 2) % 3]});
    fine.triangles.push_back(middle);
  }
  restore(fine);
}

Eigen::Vector3d ConstrainedMesh::project_between(VertexHandle a, VertexHandle b,
                                                 const Eigen::Vector3d& midpoint,
                                                 Anchor& anchor) const {
  const Eigen::Vector3d outward = normal(a) + normal(b);
  const double length = vector_between(mesh, b, a).norm();
  for (const double lift : {0.0, 0.125, 0.25, 0.5}) {
    const Eigen::Vector3d lifted = midpoint + lift * length * outward.normalized();
    const SurfacePoint foot = surface_->nearest(lifted, anchor.face);
    if (surface_->normal(foot).dot(outward) <= 0.0 && lift < 0.5 && outward.norm() > 0.5) continue;
    anchor.face = foot.face;
    return foot.position;
  }
  return midpoint;
}

SurfacePoint ConstrainedMesh::foot(const Eigen::Vector3d& p, int face) const {
  if (!reach_) return surface_->nearest(p, face);
  const SurfacePoint near = surface_->walk_towards(p, face);
  if ((near.position - p).norm() <= *reach_) return near;
  const SurfacePoint nearest = surface_->nearest(p, near.face);
  return surface_->normal(nearest).dot(surface_->normal(near)) > 0.0 ? nearest : near;
}

Eigen::Vector3d ConstrainedMesh::project(const Eigen::Vector3d& p, Anchor& anchor) const {
  if (anchor.kind == FeatureKind::curve) {
    anchor.on_curve = curves_.nearest(p, anchor.on_curve);
    anchor.face = foot(anchor.on_curve.position, anchor.face).face;
    return anchor.on_curve.position;
  }
  const SurfacePoint on_surface = foot(p, anchor.face);
  anchor.face = on_surface.face;
  return on_surface.position;
}

Eigen::Vector3d ConstrainedMesh::normal(VertexHandle v) const {
  return surface_->normal({mesh.point(v), anchors_[v].face});
}

}  // namespace trivalent::remesh
