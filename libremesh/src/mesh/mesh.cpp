#include "trivalent/remesh/mesh.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "mesh/edge_table.h"
#include "mesh/geometry.h"
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

/// Two faces that run the same way along an edge.
struct Clash {
  EdgeUse first;
  EdgeUse second;
};

/// Every directed edge may be used by one face only; in an oriented 2-manifold the other direction
/// belongs to the face on the other side.
void check_edges(std::span<const std::array<int, 3>> triangles) {
  std::optional<Clash> clash;
  const std::vector<EdgeUse> uses = edge_uses(triangles);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (std::size_t i = 1; i < edge.size(); ++i) {
      const auto same =
          std::find_if(edge.begin(), edge.begin() + static_cast<std::ptrdiff_t>(i),
                       [&](const EdgeUse& e) { return e.upwards == edge[i].upwards; });
      if (same == edge.begin() + static_cast<std::ptrdiff_t>(i)) continue;
      if (!clash || edge[i].face < clash->second.face) clash = {*same, edge[i]};
      break;
    }
  });
  if (!clash) return;
  const auto& [first, second] = *clash;
  throw InvalidMesh(concat("make_mesh: faces ", first.face, " and ", second.face,
                           " run the same way along the edge from vertex ",
                           second.upwards ? second.low : second.high, " to ",
                           second.upwards ? second.high : second.low,
                           "; the surface is not manifold or not consistently oriented there"));
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

int euler_characteristic(const TriMesh& mesh) {
  return static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) +
         static_cast<int>(mesh.n_faces());
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
  for (const auto e : mesh.edges()) sum += edge_length(mesh, e);
  return sum / static_cast<double>(mesh.n_edges());
}

double surface_area(const TriMesh& mesh) {
  double area = 0.0;
  for (const auto f : mesh.faces()) area += face_area(mesh, f);
  return area;
}

std::vector<Eigen::Vector3d> face_centroids(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> centroids;
  centroids.reserve(mesh.n_faces());
  for (const auto f : mesh.faces())
    centroids.push_back(mesh.lattice.wrapped(face_centroid(mesh, f)));
  return centroids;
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
  if (mesh.lattice.is_periodic()) mesh.lattice = mesh.lattice.scaled(factor);
}

}  // namespace trivalent::remesh
