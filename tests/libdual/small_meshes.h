#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh_fixtures.h"

namespace testing_support {

using Triangles = std::vector<std::array<int, 3>>;

/// Torus of n_long × n_short quads around z, each cut into two triangles: every valence is 6.
inline trivalent::remesh::TriMesh torus(int n_long, int n_short) {
  const double ring_radius = 3.0;
  const double tube_radius = 1.0;
  std::vector<Eigen::Vector3d> points;
  Triangles triangles;
  for (int i = 0; i < n_long; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n_long;
    for (int j = 0; j < n_short; ++j) {
      const double v = 2.0 * std::numbers::pi * j / n_short;
      const double radius = ring_radius + tube_radius * std::cos(v);
      points.emplace_back(radius * std::cos(u), radius * std::sin(u), tube_radius * std::sin(v));
      const int next_i = (i + 1) % n_long * n_short;
      const int next_j = (j + 1) % n_short;
      triangles.push_back({i * n_short + j, next_i + j, next_i + next_j});
      triangles.push_back({i * n_short + j, next_i + next_j, i * n_short + next_j});
    }
  }
  return trivalent::remesh::make_mesh(points, triangles);
}

/// Flat sheet of nx × ny rhombi of equilateral triangles with the given edge length, seen from +z.
inline trivalent::remesh::TriMesh flat_sheet(int nx, int ny, double edge_length) {
  std::vector<Eigen::Vector3d> points;
  Triangles triangles;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      points.emplace_back(edge_length * (i + 0.5 * j), edge_length * j * std::sqrt(0.75), 0.0);
      if (i == nx || j == ny) continue;
      const int corner = j * (nx + 1) + i;
      triangles.push_back({corner, corner + 1, corner + nx + 1});
      triangles.push_back({corner + 1, corner + nx + 2, corner + nx + 1});
    }
  }
  return trivalent::remesh::make_mesh(points, triangles);
}

}  // namespace testing_support
