#include "trivalent/remesh/surface_shape.h"

#include <cmath>
#include <vector>

namespace trivalent::remesh {

namespace {

/// Signed angle between the normals of an edge's faces: > 0 where the surface is convex; 0 at a
/// boundary.
double bend_at(const TriMesh& mesh, EdgeHandle edge) {
  if (mesh.is_boundary(edge)) return 0.0;
  const double angle = mesh.calc_dihedral_angle(edge);
  return std::isfinite(angle) ? angle : 0.0;
}

}  // namespace

FeatureLines find_feature_lines(const TriMesh& mesh, double angle) {
  FeatureLines lines;
  for (const auto e : mesh.edges()) {
    if (std::abs(bend_at(mesh, e)) <= angle) continue;
    ++lines.edges;
    lines.length += mesh.calc_edge_length(e);
  }
  return lines;
}

double tightly_curved_fraction(const TriMesh& mesh, double radius) {
  std::vector<double> area(mesh.n_vertices(), 0.0);  // a third of the faces around
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.fv_range(f)) area[index(v)] += mesh.calc_face_area(f) / 3.0;
  }
  // Integral of the mean curvature: half the angle times the length of an edge, which its two
  // vertices share.
  std::vector<double> bend(mesh.n_vertices(), 0.0);
  for (const auto e : mesh.edges()) {
    const double share = 0.25 * bend_at(mesh, e) * mesh.calc_edge_length(e);
    bend[index(e.v0())] += share;
    bend[index(e.v1())] += share;
  }
  double tight = 0.0;
  double total = 0.0;
  for (std::size_t v = 0; v < area.size(); ++v) {
    total += area[v];
    if (std::abs(bend[v]) * radius > area[v]) tight += area[v];
  }
  return total > 0.0 ? tight / total : 0.0;
}

}  // namespace trivalent::remesh
