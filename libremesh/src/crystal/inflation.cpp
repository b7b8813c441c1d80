#include "crystal/inflation.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace trivalent::remesh {

std::optional<TriMesh> inflated(const ConstrainedMesh& on_surface, double thickness) {
  constexpr int smoothing_steps = 5;
  const TriMesh& surface = on_surface.mesh;
  const auto may_move = [&](VertexHandle v) {
    return on_surface.anchor(v).kind == FeatureKind::none && !surface.is_isolated(v);
  };
  std::vector<double> lift(surface.n_vertices(), 0.0);
  tbb::parallel_for(std::size_t{0}, lift.size(), [&](std::size_t i) {
    const VertexHandle v(static_cast<int>(i));
    if (may_move(v)) lift[i] = 0.5 * std::max(0.0, thickness - on_surface.surface().thickness(v));
  });
  if (std::ranges::max(lift) == 0.0) return std::nullopt;
  for (int step = 0; step < smoothing_steps; ++step) {
    const std::vector<double> before = lift;
    for (const auto v : surface.vertices()) {
      if (!may_move(v)) continue;
      double sum = 0.0;
      for (const auto w : surface.vv_range(v)) sum += before[index(w)];
      lift[index(v)] = 0.5 * (before[index(v)] + sum / surface.valence(v));
    }
  }
  TriMesh result = surface;
  for (const auto v : surface.vertices()) {
    if (lift[index(v)] > 0.0) result.point(v) += lift[index(v)] * on_surface.surface().normal(v);
  }
  return result;
}

ConstrainedMesh::State carried_over(const ConstrainedMesh::State& net, const TriMesh& from,
                                    const TriMesh& to) {
  ConstrainedMesh::State result = net;
  for (std::size_t i = 0; i < net.positions.size(); ++i) {
    const Anchor& anchor = net.anchors[i];
    if (anchor.kind != FeatureKind::none) continue;  // curves are the same
    std::array<Eigen::Vector3d, 3> a;
    std::array<Eigen::Vector3d, 3> b;
    std::size_t k = 0;
    for (const auto v : from.fv_range(FaceHandle(anchor.face))) {
      a[k] = from.point(v);
      b[k++] = to.point(v);
    }
    const Eigen::Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
    const double area = normal.squaredNorm();
    if (!(area > 0.0)) {
      result.positions[i] = b[0];
      continue;
    }
    const Eigen::Vector3d& p = net.positions[i];
    const double u = (a[1] - p).cross(a[2] - p).dot(normal) / area;
    const double v = (a[2] - p).cross(a[0] - p).dot(normal) / area;
    result.positions[i] = u * b[0] + v * b[1] + (1.0 - u - v) * b[2];
  }
  return result;
}

}  // namespace trivalent::remesh
