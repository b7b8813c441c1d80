#include "equalize/constrained_mesh.h"
#include "equalize/face_guard.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

VertexHandle ConstrainedMesh::split(EdgeHandle e) {
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  const VertexHandle from = mesh.from_vertex_handle(h);
  const VertexHandle to = mesh.to_vertex_handle(h);
  const std::optional<int> curve = curve_of(e);
  const Eigen::Vector3d middle = midpoint(mesh, from, to);
  Anchor anchor;
  anchor.face = anchors_[from].face;
  if (curve) {
    anchor.kind = FeatureKind::curve;
    anchor.on_curve = curves_.nearest(middle, *curve);
  }
  const VertexHandle v = mesh.split(e, middle);
  const Eigen::Vector3d projected = project(middle, anchor);
  if (faces_stay_upright(mesh, v, projected)) mesh.point(v) = projected;
  anchors_[v] = anchor;
  for (const auto spoke : mesh.ve_range(v)) curve_of_[spoke] = std::nullopt;
  for (const VertexHandle end : {from, to}) {
    curve_of_[mesh.edge_handle(mesh.find_halfedge(v, end))] = curve;
  }
  return v;
}

std::optional<Collapse> ConstrainedMesh::plan_collapse(EdgeHandle e) const {
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  const VertexHandle from = mesh.from_vertex_handle(h);
  const VertexHandle to = mesh.to_vertex_handle(h);
  const Anchor& a = anchors_[from];
  const Anchor& b = anchors_[to];
  if (a.kind != FeatureKind::none && b.kind != FeatureKind::none && !curve_of(e))
    return std::nullopt;
  if (a.kind == FeatureKind::corner && b.kind == FeatureKind::corner) return std::nullopt;
  Collapse plan{h, Eigen::Vector3d::Zero(), b};
  if (a.kind != b.kind) {  // the freer vertex goes
    const bool from_goes = a.kind < b.kind;
    const VertexHandle kept = from_goes ? to : from;
    plan = {from_goes ? h : mesh.opposite_halfedge_handle(h), mesh.point(kept), anchors_[kept]};
  } else {
    plan.position = project(midpoint(mesh, from, to), plan.anchor);
  }
  if (!mesh.is_collapse_ok(plan.halfedge) || !keeps_curves(plan.halfedge)) return std::nullopt;
  return plan;
}

void ConstrainedMesh::collapse(const Collapse& plan) {
  const VertexHandle removed = mesh.from_vertex_handle(plan.halfedge);
  const VertexHandle kept = mesh.to_vertex_handle(plan.halfedge);
  const auto curve_edges = curve_edges_of(removed, kept);
  mesh.collapse(plan.halfedge);
  mesh.point(kept) = plan.position;
  anchors_[kept] = plan.anchor;
  for (const auto& [neighbor, curve] : curve_edges) {
    curve_of_[mesh.edge_handle(mesh.find_halfedge(kept, neighbor))] = curve;
  }
}

bool ConstrainedMesh::flip(EdgeHandle e) {
  if (mesh.is_boundary(e) || curve_of(e)) return false;
  if (!mesh.is_flip_ok(e) || !flip_stays_upright(mesh, e)) return false;
  mesh.flip(e);
  return true;
}

/// Merging two sides of a triangle that both lie on curves would close the curve onto itself.
bool ConstrainedMesh::keeps_curves(HalfedgeHandle h) const {
  for (const HalfedgeHandle side : {h, mesh.opposite_halfedge_handle(h)}) {
    if (mesh.is_boundary(side)) continue;
    const EdgeHandle next = mesh.edge_handle(mesh.next_halfedge_handle(side));
    const EdgeHandle previous = mesh.edge_handle(mesh.prev_halfedge_handle(side));
    if (curve_of(next) && curve_of(previous)) return false;
  }
  return true;
}

std::vector<std::pair<VertexHandle, int>> ConstrainedMesh::curve_edges_of(
    VertexHandle v, VertexHandle except) const {
  std::vector<std::pair<VertexHandle, int>> edges;
  for (const auto h : mesh.voh_range(v)) {
    const std::optional<int> curve = curve_of(mesh.edge_handle(h));
    if (curve && mesh.to_vertex_handle(h) != except)
      edges.emplace_back(mesh.to_vertex_handle(h), *curve);
  }
  return edges;
}

}  // namespace trivalent::remesh
