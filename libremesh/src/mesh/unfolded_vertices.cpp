#include "mesh/unfolded_vertices.h"

#include "mesh/geometry.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

std::array<Eigen::Vector3d, 3> corners_in_cell(const TriMesh& mesh, FaceHandle f) {
  std::array<Eigen::Vector3d, 3> corners = corners_of(mesh, f);
  const Eigen::Vector3d home = mesh.lattice.wrapped(corners[0]) - corners[0];
  for (Eigen::Vector3d& corner : corners) corner += home;
  return corners;
}

TriangleSoup soup_of(const TriMesh& mesh) {
  TriangleSoup soup;
  if (!mesh.lattice.is_periodic()) {
    soup.points.assign(mesh.points(), mesh.points() + mesh.n_vertices());
    soup.triangles = triangles_of(mesh);
    return soup;
  }
  UnfoldedVertices vertices(mesh, soup.points);
  for (const auto f : mesh.faces()) {
    soup.triangles.push_back(vertices.numbers(f, corners_in_cell(mesh, f)));
  }
  return soup;
}

}  // namespace trivalent::remesh
