#include "surface_projector.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <cmath>

#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

// Distances need no exact predicates, so the fastest kernel serves.
using Kernel = CGAL::Simple_cartesian<double>;
using Primitive =
    CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Eigen::Vector3d to_eigen(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Vertex normals weighted by the faces' angles, which does not depend on how a polygon was split.
std::vector<Eigen::Vector3d> angle_weighted_normals(const TriMesh& surface) {
  std::vector<Eigen::Vector3d> normals(surface.n_vertices(), Eigen::Vector3d::Zero());
  for (const auto f : surface.faces()) {
    const Eigen::Vector3d n = surface.calc_normal(f);
    if (!n.allFinite()) continue;
    for (const auto h : surface.fh_range(f)) {
      const double angle = surface.calc_sector_angle(h);
      if (std::isfinite(angle)) normals[static_cast<std::size_t>(h.to().idx())] += angle * n;
    }
  }
  return normals;
}

}  // namespace

struct SurfaceProjector::Impl {
  std::vector<Kernel::Triangle_3> triangles;  // those with an area
  std::vector<int> face_of;                   // face of the surface, per triangle
  std::vector<int> triangle_of;               // triangle, per face of the surface
  std::vector<std::array<int, 3>> corners;    // vertices, per face of the surface
  std::vector<Eigen::Vector3d> vertex_normals;
  Tree tree;

  [[nodiscard]] SurfacePoint answer(const Tree::Point_and_primitive_id& hit) const {
    const auto triangle = static_cast<std::size_t>(hit.second - triangles.begin());
    return {to_eigen(hit.first), face_of[triangle]};
  }
};

SurfaceProjector::SurfaceProjector(const TriMesh& surface) : impl_(std::make_unique<Impl>()) {
  impl_->corners = triangles_of(surface);
  impl_->triangle_of.assign(surface.n_faces(), 0);
  for (std::size_t f = 0; f < impl_->corners.size(); ++f) {
    const auto [a, b, c] = impl_->corners[f];
    const Kernel::Triangle_3 triangle(to_cgal(surface.point(VertexHandle(a))),
                                      to_cgal(surface.point(VertexHandle(b))),
                                      to_cgal(surface.point(VertexHandle(c))));
    impl_->triangle_of[f] = static_cast<int>(impl_->triangles.size());
    if (triangle.is_degenerate()) continue;  // nearest points need an area; the neighbors cover it
    impl_->triangles.push_back(triangle);
    impl_->face_of.push_back(static_cast<int>(f));
  }
  if (impl_->triangles.empty()) {
    throw InvalidMesh("surface projector: no face of the surface has an area");
  }
  for (int& t : impl_->triangle_of) t = std::min(t, static_cast<int>(impl_->triangles.size()) - 1);
  impl_->vertex_normals = angle_weighted_normals(surface);
  impl_->tree.rebuild(impl_->triangles.cbegin(), impl_->triangles.cend());
  impl_->tree.build();
}

SurfaceProjector::~SurfaceProjector() = default;
SurfaceProjector::SurfaceProjector(SurfaceProjector&&) noexcept = default;
SurfaceProjector& SurfaceProjector::operator=(SurfaceProjector&&) noexcept = default;

SurfacePoint SurfaceProjector::nearest(const Eigen::Vector3d& p) const {
  return impl_->answer(impl_->tree.closest_point_and_primitive(to_cgal(p)));
}

SurfacePoint SurfaceProjector::nearest(const Eigen::Vector3d& p, int face) const {
  const auto triangle =
      impl_->triangles.cbegin() + impl_->triangle_of[static_cast<std::size_t>(face)];
  const Kernel::Point_3 on_triangle =
      Kernel().construct_projected_point_3_object()(*triangle, to_cgal(p));
  return impl_->answer(
      impl_->tree.closest_point_and_primitive(to_cgal(p), {on_triangle, triangle}));
}

Eigen::Vector3d SurfaceProjector::normal(const SurfacePoint& p) const {
  const auto face = static_cast<std::size_t>(p.face);
  const Kernel::Triangle_3& t =
      impl_->triangles[static_cast<std::size_t>(impl_->triangle_of[face])];
  const Eigen::Vector3d a = to_eigen(t[0]);
  const Eigen::Vector3d b = to_eigen(t[1]);
  const Eigen::Vector3d c = to_eigen(t[2]);
  const Eigen::Vector3d face_normal = (b - a).cross(c - a);
  const double area = face_normal.squaredNorm();
  const double at_a = (b - p.position).cross(c - p.position).dot(face_normal) / area;
  const double at_b = (c - p.position).cross(a - p.position).dot(face_normal) / area;
  const auto vertex_normal = [&](std::size_t k) {
    return impl_->vertex_normals[static_cast<std::size_t>(impl_->corners[face][k])].normalized();
  };
  const Eigen::Vector3d n =
      at_a * vertex_normal(0) + at_b * vertex_normal(1) + (1.0 - at_a - at_b) * vertex_normal(2);
  // Across a sharp fold vertex normals may cancel or point away; the face itself is then right.
  if (n.dot(face_normal) <= 0.1 * n.norm() * face_normal.norm()) return face_normal.normalized();
  return n.normalized();
}

}  // namespace trivalent::remesh
