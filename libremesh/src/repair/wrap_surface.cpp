#include "repair/wrap_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

namespace trivalent::remesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

TriangleSoup soup_of(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  std::vector<int> index(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), 0);
  for (const auto v : mesh.vertices()) {
    index[v] = static_cast<int>(soup.points.size());
    const Kernel::Point_3& p = mesh.point(v);
    soup.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) corners[k++] = index[v];
    soup.triangles.push_back(corners);
  }
  return soup;
}

}  // namespace

TriangleSoup wrap_surface(const TriangleSoup& soup, const WrapLengths& lengths) {
  std::vector<Kernel::Point_3> points;
  points.reserve(soup.points.size());
  for (const Eigen::Vector3d& p : soup.points) points.emplace_back(p.x(), p.y(), p.z());
  SurfaceMesh wrap;
  if (soup.triangles.empty()) {
    CGAL::alpha_wrap_3(points, lengths.alpha, lengths.offset, wrap);
  } else {
    CGAL::alpha_wrap_3(points, soup.triangles, lengths.alpha, lengths.offset, wrap);
  }
  return soup_of(wrap);
}

}  // namespace trivalent::remesh
