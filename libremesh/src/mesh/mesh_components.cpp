#include "trivalent/remesh/mesh_components.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace trivalent::remesh {

namespace {

/// Faces in an order in which each component is in one piece, and where that piece ends.
struct FacesByComponent {
  std::vector<FaceHandle> faces;
  std::vector<std::size_t> ends;  ///< one per component
};

FacesByComponent walk_over_components(const TriMesh& mesh) {
  FacesByComponent walk;
  walk.faces.reserve(mesh.n_faces());
  std::vector<char> is_seen(mesh.n_faces(), 0);
  const auto visit = [&](FaceHandle face) {
    if (std::exchange(is_seen[static_cast<std::size_t>(face.idx())], 1) == 0)
      walk.faces.push_back(face);
  };
  for (const auto start : mesh.faces()) {
    const std::size_t begin = walk.faces.size();
    visit(start);
    for (std::size_t i = begin; i < walk.faces.size(); ++i) {
      for (const auto next : mesh.ff_range(walk.faces[i])) visit(next);
    }
    if (walk.faces.size() > begin) walk.ends.push_back(walk.faces.size());
  }
  return walk;
}

std::array<Eigen::Vector3d, 3> corners_of(const TriMesh& mesh, FaceHandle face) {
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t k = 0;
  for (const auto v : mesh.fv_range(face)) corners[k++] = mesh.point(v);
  return corners;
}

/// @param is_counted  Of every vertex; those of other components may be.
MeshComponent measure(const TriMesh& mesh, std::span<const FaceHandle> faces,
                      std::vector<char>& is_counted) {
  MeshComponent part;
  const Eigen::Vector3d origin = corners_of(mesh, faces.front())[0];
  part.box = {origin, origin};
  for (const FaceHandle face : faces) {
    const auto [a, b, c] = corners_of(mesh, face);
    part.area += 0.5 * (b - a).cross(c - a).norm();
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
  if (!part.is_closed()) part.volume = 0.0;
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
  const auto faces_of = [&](std::size_t i) {
    const std::size_t begin = i == 0 ? 0 : walk.ends[i - 1];
    return std::span(walk.faces).subspan(begin, walk.ends[i] - begin);
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Eigen::Vector3d p = corners_of(mesh, faces_of(i).front())[0];
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const double volume = std::abs(parts[j].volume);
      if (i == j || !parts[j].is_closed() || volume >= smallest) continue;
      if (!encloses(parts[j].box, parts[i].box)) continue;
      if (std::abs(winding_number(mesh, faces_of(j), p)) < 0.5) continue;
      smallest = volume;
      parts[i].inside_of = static_cast<int>(j);
    }
  }
}

}  // namespace

double longest_edge_for(double area, bool is_closed) {
  const double unit_area = std::sqrt(3.0) / 4.0;  // of an equilateral triangle of edge 1
  const double least_faces = is_closed ? 20.0 : 2.0;
  return std::sqrt(area / least_faces / unit_area);
}

double longest_edge_along(double area, double length) { return 2.0 * area / length; }

MeshComponents find_components(const TriMesh& mesh) {
  const FacesByComponent walk = walk_over_components(mesh);
  MeshComponents components;
  components.of_face.resize(mesh.n_faces());
  std::vector<char> is_counted(mesh.n_vertices(), 0);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < walk.ends.size(); ++i) {
    const auto faces = std::span(walk.faces).subspan(begin, walk.ends[i] - begin);
    for (const FaceHandle f : faces)
      components.of_face[static_cast<std::size_t>(f.idx())] = static_cast<int>(i);
    components.parts.push_back(measure(mesh, faces, is_counted));
    begin = walk.ends[i];
  }
  find_nesting(mesh, walk, components.parts);
  return components;
}

}  // namespace trivalent::remesh
