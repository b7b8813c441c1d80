#include "constrained_mesh.h"

namespace trivalent::remesh {

ConstrainedMesh::ConstrainedMesh(TriMesh& original, std::optional<double> feature_angle)
    : mesh(original),
      surface_(original),
      curves_(original, feature_angle),
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

Eigen::Vector3d ConstrainedMesh::project(const Eigen::Vector3d& p, Anchor& anchor) const {
  if (anchor.kind == FeatureKind::curve) {
    anchor.on_curve = curves_.nearest(p, anchor.on_curve);
    anchor.face = surface_.nearest(anchor.on_curve.position, anchor.face).face;
    return anchor.on_curve.position;
  }
  const SurfacePoint foot = surface_.nearest(p, anchor.face);
  anchor.face = foot.face;
  return foot.position;
}

Eigen::Vector3d ConstrainedMesh::normal(VertexHandle v) const {
  return surface_.normal({mesh.point(v), anchors_[v].face});
}

}  // namespace trivalent::remesh
