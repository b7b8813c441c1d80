#include "trivalent/remesh/mesh.h"

#include <algorithm>
#include <unordered_map>

#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

void check_corners(std::span<const Eigen::Vector3d> points,
                   std::span<const std::array<int, 3>> triangles) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw InvalidMesh(
          concat("make_mesh: vertex ", i, " has a coordinate that is not a finite number"));
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    for (const int corner : {a, b, c}) {
      if (corner < 0 || static_cast<std::size_t>(corner) >= points.size()) {
        throw InvalidMesh(concat("make_mesh: face ", t, " refers to vertex ", corner, " of ",
                                 points.size(), " (counted from 0)"));
      }
    }
    if (a == b || b == c || c == a) {
      throw InvalidMesh(concat("make_mesh: face ", t, " repeats a vertex (", a, ", ", b, ", ", c,
                               "); remove degenerate faces first"));
    }
  }
}

/// Every directed edge may be used by one face only; in an oriented 2-manifold the other direction
/// belongs to the face on the other side.
void check_edges(std::span<const std::array<int, 3>> triangles) {
  std::unordered_map<std::uint64_t, std::size_t> face_on;
  face_on.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangles[t][k];
      const int to = triangles[t][(k + 1) % 3];
      const auto key = static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
      const auto [other, is_new] = face_on.try_emplace(key, t);
      if (!is_new) {
        throw InvalidMesh(
            concat("make_mesh: faces ", other->second, " and ", t,
                   " run the same way along the edge from vertex ", from, " to ", to,
                   "; the surface is not manifold or not consistently oriented there"));
      }
    }
  }
}

void check_fans(const TriMesh& mesh) {
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_manifold(v)) {
      throw InvalidMesh(concat("make_mesh: more than one fan of faces meets at vertex ", v.idx(),
                               "; split that vertex first"));
    }
  }
}

}  // namespace

TriMesh make_mesh(std::span<const Eigen::Vector3d> points,
                  std::span<const std::array<int, 3>> triangles) {
  check_corners(points, triangles);
  check_edges(triangles);
  TriMesh mesh;
  mesh.reserve(points.size(), points.size() + triangles.size(), triangles.size());
  for (const Eigen::Vector3d& p : points) mesh.add_vertex(p);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    const FaceHandle face = mesh.add_face(VertexHandle(a), VertexHandle(b), VertexHandle(c));
    if (!face.is_valid()) {
      throw InvalidMesh(
          concat("make_mesh: face ", t, " (vertices ", a, ", ", b, ", ", c,
                 ") closes a fan that is not a disc; the surface is not manifold there"));
    }
  }
  check_fans(mesh);
  return mesh;
}

std::vector<std::array<int, 3>> triangles_of(const TriMesh& mesh) {
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(mesh.n_faces());
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.fv_range(f)) corners[k++] = v.idx();
    triangles.push_back(corners);
  }
  return triangles;
}

double mean_edge_length(const TriMesh& mesh) {
  if (mesh.n_edges() == 0) return 0.0;
  double sum = 0.0;
  for (const auto e : mesh.edges()) sum += mesh.calc_edge_length(e);
  return sum / static_cast<double>(mesh.n_edges());
}

double surface_area(const TriMesh& mesh) {
  double area = 0.0;
  for (const auto f : mesh.faces()) area += mesh.calc_face_area(f);
  return area;
}

BoundingBox bounding_box(const TriMesh& mesh) {
  BoundingBox box;
  bool first = true;
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d& p = mesh.point(v);
    box.low = first ? p : Eigen::Vector3d(box.low.cwiseMin(p));
    box.high = first ? p : Eigen::Vector3d(box.high.cwiseMax(p));
    first = false;
  }
  return box;
}

void scale(TriMesh& mesh, double factor) {
  for (const auto v : mesh.vertices()) mesh.point(v) *= factor;
}

}  // namespace trivalent::remesh
