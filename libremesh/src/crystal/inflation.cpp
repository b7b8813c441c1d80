#include "crystal/inflation.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/geometry.h"

namespace trivalent::remesh {

bool is_too_thin(const ConstrainedMesh& on_surface, double length) {
  const TriMesh& surface = on_surface.mesh;
  std::vector<char> is_thin(surface.n_vertices(), 0);
  tbb::parallel_for(std::size_t{0}, is_thin.size(), [&](std::size_t i) {
    const VertexHandle v(static_cast<int>(i));
    if (surface.is_isolated(v)) return;
    is_thin[i] = on_surface.surface().thickness(v) < 0.5 * length ? 1 : 0;
  });
  double thin = 0.0;
  double whole = 0.0;
  for (const auto f : surface.faces()) {
    const double area = face_area(surface, f);
    whole += area;
    if (std::ranges::all_of(f.vertices(), [&](auto v) { return is_thin[index(v)] != 0; })) {
      thin += area;
    }
  }
  return thin > 0.5 * whole;
}

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
    const FaceHandle f(anchor.face);
    const std::array<Eigen::Vector3d, 3> there = corners_of(to, f);
    const std::array<Eigen::Vector3d, 3> here = corners_of(from, f);
    const Eigen::Vector3d share = barycentric(here, from.lattice.near(here[0], net.positions[i]));
    result.positions[i] =
        share.allFinite()
            ? Eigen::Vector3d(share[0] * there[0] + share[1] * there[1] + share[2] * there[2])
            : there[0];
  }
  return result;
}

}  // namespace trivalent::remesh
