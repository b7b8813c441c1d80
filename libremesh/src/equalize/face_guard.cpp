#include "equalize/face_guard.h"

#include <Eigen/Geometry>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Smallest height / longest side of a triangle that counts as one.
constexpr double min_aspect = 1e-3;

bool is_sliver(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest_squared =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return doubled_area_vector(a, b, c).norm() <= min_aspect * longest_squared;
}

}  // namespace

bool faces_stay_upright(const TriMesh& mesh, VertexHandle v, const Eigen::Vector3d& position,
                        VertexHandle except) {
  const Eigen::Vector3d to = mesh.lattice.near(mesh.point(v), position);
  for (const auto h : mesh.voh_range(v)) {
    if (mesh.is_boundary(h)) continue;
    const VertexHandle b = mesh.to_vertex_handle(h);
    const VertexHandle c = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
    if (b == except || c == except) continue;
    const Eigen::Vector3d& from = mesh.point(v);
    const Eigen::Vector3d at_b = position_beside(mesh, v, b);
    const Eigen::Vector3d at_c = position_beside(mesh, v, c);
    if (!mesh.lattice.is_nearest(at_b - to)) return false;
    const Eigen::Vector3d before = doubled_area_vector(from, at_b, at_c);
    const Eigen::Vector3d after = doubled_area_vector(to, at_b, at_c);
    if (before.dot(after) < 0.0) return false;
    if (is_sliver(to, at_b, at_c) && !is_sliver(from, at_b, at_c)) return false;
  }
  return true;
}

bool flip_stays_upright(const TriMesh& mesh, EdgeHandle e) {
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  const HalfedgeHandle o = mesh.halfedge_handle(e, 1);
  const VertexHandle from = mesh.from_vertex_handle(h);
  const auto beside = [&](VertexHandle v) { return position_beside(mesh, from, v); };
  const Eigen::Vector3d& v1 = mesh.point(from);
  const Eigen::Vector3d v3 = beside(mesh.to_vertex_handle(h));
  const Eigen::Vector3d v4 = beside(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
  const Eigen::Vector3d v2 = beside(mesh.to_vertex_handle(mesh.next_halfedge_handle(o)));
  if (!mesh.lattice.is_nearest(v4 - v2)) return false;
  const Eigen::Vector3d upward = doubled_area_vector(v1, v2, v3) + doubled_area_vector(v1, v3, v4);
  if (is_sliver(v1, v2, v4) || is_sliver(v2, v3, v4)) return false;
  return doubled_area_vector(v1, v2, v4).dot(upward) > 0.0 &&
         doubled_area_vector(v2, v3, v4).dot(upward) > 0.0;
}

}  // namespace trivalent::remesh
