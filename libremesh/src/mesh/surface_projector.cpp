#include "mesh/surface_projector.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

// Distances need no exact predicates, so the fastest kernel serves.
using TreeKernel = CGAL::Simple_cartesian<double>;
using Primitive =
    CGAL::AABB_triangle_primitive<TreeKernel, std::vector<TreeKernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<TreeKernel, Primitive>>;

TreeKernel::Point_3 to_cgal(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Eigen::Vector3d to_eigen(const TreeKernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Halves the triangles of a node of the tree along its box's longest side, as CGAL does; but where
/// that does not tell needles apart, which all reach from end to end, along the direction in which
/// they lie side by side.
class SplitTriangles {
 public:
  explicit SplitTriangles(const Tree::AABB_traits& traits) : by_box_(traits) {}

  template <typename Iterator>
  void operator()(Iterator first, Iterator beyond, const CGAL::Bbox_3& box) const {
    constexpr std::ptrdiff_t few = 16;
    constexpr double hardly_any = 0.25;  // of the spread in another direction
    if (beyond - first > few) {
      Eigen::AlignedBox3d middles;
      for (Iterator t = first; t != beyond; ++t) middles.extend(middle_of(*t));
      int widest = 0;
      int longest = 0;
      middles.sizes().maxCoeff(&widest);
      Eigen::Vector3d(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin())
          .maxCoeff(&longest);
      if (middles.sizes()[longest] < hardly_any * middles.sizes()[widest]) {
        std::nth_element(first, first + (beyond - first) / 2, beyond,
                         [widest](const Primitive& a, const Primitive& b) {
                           return middle_of(a)[widest] < middle_of(b)[widest];
                         });
        return;
      }
    }
    by_box_(first, beyond, box);
  }

 private:
  static Eigen::Vector3d middle_of(const Primitive& primitive) {
    const TreeKernel::Triangle_3& t = *primitive.id();
    return (to_eigen(t[0]) + to_eigen(t[1]) + to_eigen(t[2])) / 3.0;
  }

  Tree::AABB_traits::Split_primitives by_box_;
};

/// Vertex normals weighted by the faces' angles, which does not depend on how a polygon was split.
std::vector<Eigen::Vector3d> angle_weighted_normals(const TriMesh& surface) {
  std::vector<Eigen::Vector3d> normals(surface.n_vertices(), Eigen::Vector3d::Zero());
  for (const auto f : surface.faces()) {
    const Eigen::Vector3d n = face_normal(surface, f);
    if (!n.allFinite()) continue;
    for (const auto h : surface.fh_range(f)) {
      const double angle = corner_angle(surface, h);
      if (std::isfinite(angle)) normals[static_cast<std::size_t>(h.to().idx())] += angle * n;
    }
  }
  for (Eigen::Vector3d& n : normals) n.normalize();
  return normals;
}

/// The point of a triangle nearest to another point.
struct Foot {
  Eigen::Vector3d position;
  double squared_distance;
  /// Corners whose barycentric coordinate is not 0: bits 0 to 2.
  unsigned corners;
};

Foot foot_on(const std::array<Eigen::Vector3d, 3>& t, const Eigen::Vector3d& p) {
  const auto foot = [&](const Eigen::Vector3d& at, unsigned corners) -> Foot {
    return {at, (at - p).squaredNorm(), corners};
  };
  // By the regions of [Ericson2004, 5.1.5]: three corners, three edges, the inside.
  const Eigen::Vector3d ab = t[1] - t[0];
  const Eigen::Vector3d ac = t[2] - t[0];
  const Eigen::Vector3d ap = p - t[0];
  const double ab_a = ab.dot(ap);
  const double ac_a = ac.dot(ap);
  if (ab_a <= 0.0 && ac_a <= 0.0) return foot(t[0], 1U);
  const Eigen::Vector3d bp = p - t[1];
  const double ab_b = ab.dot(bp);
  const double ac_b = ac.dot(bp);
  if (ab_b >= 0.0 && ac_b <= ab_b) return foot(t[1], 2U);
  const double c = ab_a * ac_b - ab_b * ac_a;
  if (c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0) return foot(t[0] + ab_a / (ab_a - ab_b) * ab, 3U);
  const Eigen::Vector3d cp = p - t[2];
  const double ab_c = ab.dot(cp);
  const double ac_c = ac.dot(cp);
  if (ac_c >= 0.0 && ab_c <= ac_c) return foot(t[2], 4U);
  const double b = ab_c * ac_a - ab_a * ac_c;
  if (b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0) return foot(t[0] + ac_a / (ac_a - ac_c) * ac, 5U);
  const double a = ab_b * ac_c - ab_c * ac_b;
  const double to_c = ac_b - ab_b;
  const double to_b = ab_c - ac_c;
  if (a <= 0.0 && to_c >= 0.0 && to_b >= 0.0) {
    return foot(t[1] + to_c / (to_c + to_b) * (t[2] - t[1]), 6U);
  }
  return foot(t[0] + (b * ab + c * ac) / (a + b + c), 7U);
}

}  // namespace

struct SurfaceProjector::Impl {
  std::vector<TreeKernel::Triangle_3> triangles;  // those with an area
  std::vector<int> face_of;                       // face of the surface, per triangle
  std::vector<int> triangle_of;                   // triangle, per face of the surface
  std::vector<std::array<int, 3>> corners;        // vertices, per face of the surface
  std::vector<Eigen::Vector3d> vertex_normals;
  IndexLists fans;  // triangles at every vertex
  Tree tree;
  Lattice lattice;
  std::vector<Eigen::Vector3d>
      translations;  // to the images that may be nearer than the cell's own

  void gather_fans(std::size_t n_vertices) {
    std::vector<std::array<int, 3>> with_area;
    with_area.reserve(face_of.size());
    for (const int face : face_of) with_area.push_back(corners[at(face)]);
    fans = triangles_at_vertices(with_area, n_vertices);
  }

  /// On the image of a triangle that is beside p.
  [[nodiscard]] Foot foot(int triangle, const Eigen::Vector3d& p) const {
    const TreeKernel::Triangle_3& t = triangles[at(triangle)];
    const Eigen::Vector3d here = lattice.near(to_eigen(t[0]), p);
    Foot foot = foot_on({to_eigen(t[0]), to_eigen(t[1]), to_eigen(t[2])}, here);
    if (lattice.is_periodic()) foot.position += p - here;
    return foot;
  }

  static bool is_corner(unsigned set, std::size_t k) { return (set >> k & 1U) != 0U; }

  /// The triangles around one of a set of corners: a pole may have thousands.
  [[nodiscard]] std::span<const int> smallest_fan(const std::array<int, 3>& own,
                                                  unsigned set) const {
    std::span<const int> smallest;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_corner(set, k)) continue;
      const std::span<const int> fan = fans[at(own[k])];
      if (smallest.empty() || fan.size() < smallest.size()) smallest = fan;
    }
    return smallest;
  }

  /// Whether a triangle has all of a set of another's corners.
  static bool shares(const std::array<int, 3>& others, const std::array<int, 3>& own,
                     unsigned set) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_corner(set, k) && std::ranges::count(others, own[k]) == 0) return false;
    }
    return true;
  }

  /// The triangle nearest to p of those that share the corners of a foot.
  [[nodiscard]] std::pair<int, Foot> nearest_sharing(int triangle, const Foot& foot,
                                                     const Eigen::Vector3d& p) const {
    std::pair<int, Foot> best = {triangle, foot};
    const std::array<int, 3>& own = corners[at(face_of[at(triangle)])];
    for (const int other : smallest_fan(own, foot.corners)) {
      const std::array<int, 3>& others = corners[at(face_of[at(other)])];
      if (other == triangle || !shares(others, own, foot.corners)) continue;
      const Foot next = this->foot(other, p);
      if (next.squared_distance < best.second.squared_distance) best = {other, next};
    }
    return best;
  }

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] Eigen::Vector3d vertex_position(VertexHandle v) const {
    const int t = fans[index(v)].front();
    const auto& around = corners[at(face_of[at(t)])];
    const auto k = std::ranges::find(around, v.idx()) - around.begin();
    return to_eigen(triangles[at(t)][static_cast<int>(k)]);
  }

  using Hit = Tree::Point_and_primitive_id;

  /// The point of the surface nearest to p.
  ///
  /// @param find  Returns the nearest point of the triangles in the cell.
  template <typename Find>
  [[nodiscard]] SurfacePoint nearest(const Eigen::Vector3d& p, const Find& find) const {
    const Eigen::Vector3d home = lattice.wrapped(p);
    Hit best = find(home);
    Eigen::Vector3d step = to_eigen(best.first) - home;
    const CGAL::Bbox_3 box = tree.bbox();
    const Eigen::AlignedBox3d around(Eigen::Vector3d(box.xmin(), box.ymin(), box.zmin()),
                                     Eigen::Vector3d(box.xmax(), box.ymax(), box.zmax()));
    for (const Eigen::Vector3d& translation : translations) {
      const Eigen::Vector3d image = home + translation;
      if (around.squaredExteriorDistance(image) >= step.squaredNorm()) continue;
      const Hit hit = find(image);
      const Eigen::Vector3d other = to_eigen(hit.first) - image;
      if (other.squaredNorm() >= step.squaredNorm()) continue;
      best = hit;
      step = other;
    }
    const auto triangle = static_cast<std::size_t>(best.second - triangles.begin());
    return {lattice.is_periodic() ? Eigen::Vector3d(p + step) : to_eigen(best.first),
            face_of[triangle]};
  }
};

SurfaceProjector::SurfaceProjector(const TriMesh& surface) : impl_(std::make_unique<Impl>()) {
  impl_->corners = triangles_of(surface);
  impl_->triangle_of.assign(surface.n_faces(), 0);
  impl_->lattice = surface.lattice;
  if (surface.lattice.is_periodic()) {
    impl_->translations = surface.lattice.translations_within(surface.lattice.covering_radius());
  }
  for (std::size_t f = 0; f < impl_->corners.size(); ++f) {
    const auto [a, b, c] = corners_of(surface, FaceHandle(static_cast<int>(f)));
    const Eigen::Vector3d home = surface.lattice.wrapped(a) - a;
    const TreeKernel::Triangle_3 triangle(to_cgal(a + home), to_cgal(b + home), to_cgal(c + home));
    impl_->triangle_of[f] = static_cast<int>(impl_->triangles.size());
    if (triangle.is_degenerate()) continue;  // nearest points need an area; the neighbors cover it
    impl_->triangles.push_back(triangle);
    impl_->face_of.push_back(static_cast<int>(f));
  }
  if (impl_->triangles.empty()) {
    throw InvalidMesh("surface projector: no face of the surface has an area");
  }
  for (int& t : impl_->triangle_of) t = std::min(t, static_cast<int>(impl_->triangles.size()) - 1);
  impl_->gather_fans(surface.n_vertices());
  impl_->vertex_normals = angle_weighted_normals(surface);
  impl_->tree.rebuild(impl_->triangles.cbegin(), impl_->triangles.cend());
  const Tree::AABB_traits traits;
  impl_->tree.custom_build(traits.compute_bbox_object(), SplitTriangles(traits));
}

SurfaceProjector::~SurfaceProjector() = default;
SurfaceProjector::SurfaceProjector(SurfaceProjector&&) noexcept = default;
SurfaceProjector& SurfaceProjector::operator=(SurfaceProjector&&) noexcept = default;

SurfacePoint SurfaceProjector::nearest(const Eigen::Vector3d& p) const {
  return impl_->nearest(p, [&](const Eigen::Vector3d& image) {
    return impl_->tree.closest_point_and_primitive(to_cgal(image));
  });
}

double SurfaceProjector::distance(const Eigen::Vector3d& p) const {
  if (impl_->lattice.is_periodic()) return (nearest(p).position - p).norm();
  return std::sqrt(impl_->tree.squared_distance(to_cgal(p)));
}

SurfacePoint SurfaceProjector::nearest(const Eigen::Vector3d& p, int face) const {
  const auto triangle =
      impl_->triangles.cbegin() + impl_->triangle_of[static_cast<std::size_t>(face)];
  return impl_->nearest(p, [&](const Eigen::Vector3d& image) {
    const TreeKernel::Point_3 on_triangle =
        TreeKernel().construct_projected_point_3_object()(*triangle, to_cgal(image));
    return impl_->tree.closest_point_and_primitive(to_cgal(image), {on_triangle, triangle});
  });
}

const Eigen::Vector3d& SurfaceProjector::normal(VertexHandle v) const {
  return impl_->vertex_normals[index(v)];
}

double SurfaceProjector::thickness(VertexHandle v) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::span<const int> around = impl_->fans[index(v)];
  const Eigen::Vector3d& normal = impl_->vertex_normals[index(v)];
  if (around.empty() || !normal.allFinite()) return infinity;
  const Eigen::Vector3d home = impl_->vertex_position(v);
  // Not quite straight: on symmetric shapes rays would run along edges, and slip through.
  const Eigen::Vector3d inwards = -normal + 1e-5 * Eigen::Vector3d(0.61, -0.35, 0.71);
  const auto is_beside = [&](Primitive::Id t) {
    return std::ranges::count(around, static_cast<int>(t - impl_->triangles.cbegin())) > 0;
  };
  /// From an image of the vertex to the other side in the cell, if that is nearer than before.
  const auto across = [&](const Eigen::Vector3d& p, double before) {
    const TreeKernel::Ray_3 ray(to_cgal(p),
                                TreeKernel::Vector_3(inwards.x(), inwards.y(), inwards.z()));
    const auto hit = impl_->tree.first_intersection(ray, is_beside);
    if (!hit) return before;
    const TreeKernel::Triangle_3& there = *hit->second;
    const Eigen::Vector3d a = to_eigen(there[0]);
    const Eigen::Vector3d looks = doubled_area_vector(a, to_eigen(there[1]), to_eigen(there[2]));
    const auto* point = boost::get<TreeKernel::Point_3>(&hit->first);
    if (point == nullptr || looks.dot(normal) >= 0.0) return before;
    return std::min(before, (to_eigen(*point) - p).norm());
  };
  double thickness = across(home, infinity);
  for (const Eigen::Vector3d& translation : impl_->translations) {
    thickness = across(home + translation, thickness);
  }
  return thickness;
}

SurfacePoint SurfaceProjector::walk_towards(const Eigen::Vector3d& p, int face) const {
  constexpr unsigned inside = 7U;
  int triangle = impl_->triangle_of[static_cast<std::size_t>(face)];
  Foot foot = impl_->foot(triangle, p);
  while (foot.corners != inside) {
    const auto [next, there] = impl_->nearest_sharing(triangle, foot, p);
    if (next == triangle) break;
    triangle = next;
    foot = there;
  }
  return {foot.position, impl_->face_of[static_cast<std::size_t>(triangle)]};
}

Eigen::Vector3d SurfaceProjector::normal(const SurfacePoint& p) const {
  const auto face = static_cast<std::size_t>(p.face);
  const TreeKernel::Triangle_3& t =
      impl_->triangles[static_cast<std::size_t>(impl_->triangle_of[face])];
  const Eigen::Vector3d a = to_eigen(t[0]);
  const Eigen::Vector3d b = to_eigen(t[1]);
  const Eigen::Vector3d c = to_eigen(t[2]);
  const Eigen::Vector3d face_normal = doubled_area_vector(a, b, c);
  const Eigen::Vector3d share = barycentric({a, b, c}, impl_->lattice.near(a, p.position));
  const auto vertex_normal = [&](std::size_t k) {
    return impl_->vertex_normals[static_cast<std::size_t>(impl_->corners[face][k])];
  };
  const Eigen::Vector3d n =
      share[0] * vertex_normal(0) + share[1] * vertex_normal(1) + share[2] * vertex_normal(2);
  // Across a sharp fold vertex normals may cancel or point away; the face itself is then right.
  if (n.dot(face_normal) <= 0.1 * n.norm() * face_normal.norm()) return face_normal.normalized();
  return n.normalized();
}

}  // namespace trivalent::remesh
