#include "equalize/divide_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Whether faces around one of its ends meet at a crease.
bool ends_at_crease(const TriMesh& mesh, EdgeHandle e) {
  constexpr double sharp = 40.0 * std::numbers::pi / 180.0;
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  return std::ranges::any_of(
      std::array{mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)}, [&](VertexHandle v) {
        return std::ranges::any_of(mesh.ve_range(v), [&](EdgeHandle other) {
          return !mesh.is_boundary(other) && std::abs(dihedral_angle(mesh, other)) > sharp;
        });
      });
}

/// Whether both faces of an edge are needles along it: too narrow to hold an edge of the net, so
/// that their normals are right as they are, while dividing them makes many faces.
bool lies_between_needles(const TriMesh& mesh, EdgeHandle e, double target) {
  constexpr double min_width = 0.05;  // in target lengths
  const double length = edge_length(mesh, e);
  for (const HalfedgeHandle h : {mesh.halfedge_handle(e, 0), mesh.halfedge_handle(e, 1)}) {
    if (mesh.is_boundary(h)) continue;
    const double width = 2.0 * face_area(mesh, mesh.face_handle(h)) / length;
    if (width > min_width * target) return false;
  }
  return true;
}

}  // namespace

TriMesh with_edges_divided(const TriMesh& surface, double target) {
  constexpr double longest = 3.0;        // in target lengths
  constexpr double max_of_net = 2.0;     // faces, times those of the net
  constexpr double max_of_input = 16.0;  // faces, times those of the surface
  TriMesh divided = surface;
  const double max_divided_faces =
      max_of_input * static_cast<double>(surface.n_faces()) +
      max_of_net * surface_area(surface) / (unit_triangle_area * target * target);
  // The longest first; of equal ones the one with the lower index.
  std::priority_queue<std::pair<double, int>> queue;
  const auto add = [&](EdgeHandle e) {
    const double length = edge_length(divided, e);
    if (length > longest * target && ends_at_crease(divided, e) &&
        !lies_between_needles(divided, e, target)) {
      queue.emplace(length, -e.idx());
    }
  };
  for (const auto e : divided.edges()) add(e);
  while (!queue.empty() && static_cast<double>(divided.n_faces()) < max_divided_faces) {
    const auto [length, minus_index] = queue.top();
    queue.pop();
    const EdgeHandle e(-minus_index);
    if (edge_length(divided, e) != length) continue;  // halved meanwhile
    const HalfedgeHandle h = divided.halfedge_handle(e, 0);
    const Eigen::Vector3d middle =
        midpoint(divided, divided.from_vertex_handle(h), divided.to_vertex_handle(h));
    const VertexHandle v = divided.split(e, middle);
    for (const auto spoke : divided.ve_range(v)) add(spoke);
  }
  return divided;
}

}  // namespace trivalent::remesh
