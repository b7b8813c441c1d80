#include "trivalent/remesh/mesh_components.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// @param is_counted  Of every vertex; those of other components may be.
MeshComponent measure(const TriMesh& mesh, std::span<const FaceHandle> faces,
                      std::vector<char>& is_counted) {
  MeshComponent part;
  const Eigen::Vector3d origin = corners_of(mesh, faces.front())[0];
  part.box = {origin, origin};
  for (const FaceHandle face : faces) {
    const auto [a, b, c] = corners_of(mesh, face);
    part.area += 0.5 * doubled_area_vector(a, b, c).norm();
    part.volume += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
    part.box.low = part.box.low.cwiseMin(a).cwiseMin(b).cwiseMin(c);
    part.box.high = part.box.high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
    for (const auto h : mesh.fh_range(face)) {
      if (std::exchange(is_counted[index(h.to())], 1) == 0) ++part.vertices;
      if (!h.opp().is_boundary()) continue;
      ++part.boundary_edges;
    }
  }
  part.faces = static_cast<int>(faces.size());
  part.edges = (3 * part.faces + part.boundary_edges) / 2;
  // In a lattice there need not be an inside.
  if (!part.is_closed() || mesh.lattice.is_periodic()) part.volume = 0.0;
  return part;
}

// ---- nesting -----------------------------------------------------------------------------------

bool encloses(const BoundingBox& outer, const BoundingBox& inner) {
  return (outer.low.array() <= inner.low.array()).all() &&
         (outer.high.array() >= inner.high.array()).all();
}

/// Solid angle of the faces seen from a point, in units of the full sphere: ±1 inside of a closed
/// surface, 0 outside, by the formula of [VanOosterom1983].
double winding_number(const TriMesh& mesh, std::span<const FaceHandle> faces,
                      const Eigen::Vector3d& p) {
  double angle = 0.0;
  for (const FaceHandle face : faces) {
    const auto corners = corners_of(mesh, face);
    const Eigen::Vector3d a = corners[0] - p;
    const Eigen::Vector3d b = corners[1] - p;
    const Eigen::Vector3d c = corners[2] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

void find_nesting(const TriMesh& mesh, const FacesByComponent& walk,
                  std::vector<MeshComponent>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Eigen::Vector3d p = corners_of(mesh, walk.component(i).front())[0];
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const double volume = std::abs(parts[j].volume);
      if (i == j || !parts[j].is_closed() || volume >= smallest) continue;
      if (!encloses(parts[j].box, parts[i].box)) continue;
      if (std::abs(winding_number(mesh, walk.component(j), p)) < 0.5) continue;
      smallest = volume;
      parts[i].inside_of = static_cast<int>(j);
    }
  }
}

}  // namespace

double longest_edge_for(double area, bool is_closed) {
  const double min_faces = is_closed ? 20.0 : 2.0;
  return std::sqrt(area / min_faces / unit_triangle_area);
}

double longest_edge_in(const Lattice& lattice) {
  constexpr double edges_across = 4.0;
  return lattice.shortest() / edges_across;
}

double longest_edge_along(double area, double length, bool is_closed) {
  // A little below √7.5 = 2.74 for closed ones, as edges are of about one length only.
  const double girth = is_closed ? 2.6 : 0.5;
  return area / (girth * length);
}

MeshComponents find_components(const TriMesh& mesh) {
  const FacesByComponent walk = faces_by_component(mesh);
  MeshComponents components;
  components.of_face.resize(mesh.n_faces());
  std::vector<char> is_counted(mesh.n_vertices(), 0);
  for (std::size_t i = 0; i < walk.ends.size(); ++i) {
    const std::span<const FaceHandle> faces = walk.component(i);
    for (const FaceHandle f : faces)
      components.of_face[static_cast<std::size_t>(f.idx())] = static_cast<int>(i);
    components.parts.push_back(measure(mesh, faces, is_counted));
  }
  if (!mesh.lattice.is_periodic()) find_nesting(mesh, walk, components.parts);
  return components;
}

}  // namespace trivalent::remesh
