#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "trivalent/remesh/mesh.h"

/// Small exact meshes and the invariants they are checked by, shared by all tests.
namespace testing_support {

/// Regular tetrahedron with corners on the cube [-1, 1]³: edge √8.
inline trivalent::remesh::TriMesh tetrahedron() {
  const std::vector<Eigen::Vector3d> points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return trivalent::remesh::make_mesh(points, triangles);
}

/// Cube of edge 1 with a corner at the origin; each side has two faces.
inline trivalent::remesh::TriMesh cube() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  const std::vector<std::array<int, 3>> triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                                     {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                                     {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return trivalent::remesh::make_mesh(points, triangles);
}

/// Regular octahedron with corners at distance 1 from the origin: edge √2.
inline trivalent::remesh::TriMesh octahedron() {
  const std::vector<Eigen::Vector3d> points = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                               {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                                                     {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  return trivalent::remesh::make_mesh(points, triangles);
}

/// Regular icosahedron of edge 2.
inline trivalent::remesh::TriMesh icosahedron() {
  constexpr double g = std::numbers::phi;
  const std::vector<Eigen::Vector3d> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                               {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                               {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::vector<std::array<int, 3>> triangles = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return trivalent::remesh::make_mesh(points, triangles);
}

/// Flat open rhombus of columns x rows cells in the plane z = 0, normal along +z, all edges of
/// length 1 and all interior vertices of valence 6.
inline trivalent::remesh::TriMesh triangular_sheet(int columns, int rows) {
  std::vector<Eigen::Vector3d> points;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i)
      points.emplace_back(i + 0.5 * j, 0.5 * std::sqrt(3.0) * j, 0.0);
  }
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({b, d, c});
    }
  }
  return trivalent::remesh::make_mesh(points, triangles);
}

inline bool is_closed(const trivalent::remesh::TriMesh& mesh) {
  for (const auto e : mesh.edges()) {
    if (mesh.is_boundary(e)) return false;
  }
  return true;
}

/// Volume inside a closed mesh; positive if its faces look outward.
inline double signed_volume(const trivalent::remesh::TriMesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : trivalent::remesh::triangles_of(mesh)) {
    const auto at = [&](int v) { return mesh.point(trivalent::remesh::VertexHandle(v)); };
    volume += at(a).dot(at(b).cross(at(c))) / 6.0;
  }
  return volume;
}

}  // namespace testing_support
