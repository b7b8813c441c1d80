#include "trivalent/remesh/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "mesh/self_intersections.h"

namespace trivalent::remesh {

namespace {

Spread spread_of_edges(const TriMesh& mesh) {
  if (mesh.n_edges() == 0) return {};
  std::vector<double> lengths;
  lengths.reserve(mesh.n_edges());
  double sum = 0.0;
  for (const auto e : mesh.edges()) {
    lengths.push_back(edge_length(mesh, e));
    sum += lengths.back();
  }
  const auto n = static_cast<double>(lengths.size());
  Spread spread;
  spread.mean = sum / n;
  double squares = 0.0;
  for (const double length : lengths) squares += (length - spread.mean) * (length - spread.mean);
  spread.standard_deviation = std::sqrt(squares / n);
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  spread.min = *shortest;
  spread.max = *longest;
  return spread;
}

void count_elements(const TriMesh& mesh, MeshQuality& quality) {
  for (const auto v : mesh.vertices()) quality.vertices += mesh.is_isolated(v) ? 0 : 1;
  quality.edges = static_cast<int>(mesh.n_edges());
  quality.faces = static_cast<int>(mesh.n_faces());
  quality.euler_characteristic = quality.vertices - quality.edges + quality.faces;
}

void count_valences(const TriMesh& mesh, MeshQuality& quality) {
  int interior = 0;
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v) || mesh.is_boundary(v)) continue;
    ++interior;
    ++quality.valences[static_cast<int>(mesh.valence(v))];
  }
  const auto regular = quality.valences.find(6);
  if (regular != quality.valences.end())
    quality.regular_fraction = static_cast<double>(regular->second) / interior;
}

void measure_angles(const TriMesh& mesh, MeshQuality& quality) {
  if (mesh.n_faces() == 0) return;
  quality.smallest_angle = std::numbers::pi;
  for (const auto f : mesh.faces()) {
    const std::array<Eigen::Vector3d, 3> corners = corners_of(mesh, f);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = corners[(k + 1) % 3] - corners[k];
      const Eigen::Vector3d b = corners[(k + 2) % 3] - corners[k];
      // Unlike the arc cosine, exact for the smallest angles too.
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      quality.smallest_angle = std::min(quality.smallest_angle, angle);
      quality.largest_angle = std::max(quality.largest_angle, angle);
    }
  }
}

}  // namespace

MeshQuality measure_quality(const TriMesh& mesh) {
  MeshQuality quality;
  count_elements(mesh, quality);
  quality.components = static_cast<int>(faces_by_component(mesh).ends.size());
  quality.boundary_loops = static_cast<int>(boundary_loops(mesh).size());
  quality.edge_length = spread_of_edges(mesh);
  count_valences(mesh, quality);
  measure_angles(mesh, quality);
  quality.self_intersections = static_cast<int>(find_crossing_faces(mesh).count);
  return quality;
}

}  // namespace trivalent::remesh
