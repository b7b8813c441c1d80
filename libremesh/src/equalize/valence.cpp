#include "equalize/valence.h"

#include "equalize/face_guard.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// A flip makes others worthwhile; a second pass takes them up, further ones find next to nothing.
constexpr int passes = 2;
/// The flipped edge must be shorter than this part of the old one to break a tie, so that no edge
/// flips back and forth for a rounding error.
constexpr double shorter = 0.99;

/// Flipping takes an edge from both ends and gives one to both opposite vertices.
bool flip_improves(const TriMesh& mesh, const EdgeNeighborhood& around,
                   const std::vector<int>& deviations) {
  const int d1 = deviations[index(around.v1)];
  const int d2 = deviations[index(around.v2)];
  const int d3 = deviations[index(around.v3)];
  const int d4 = deviations[index(around.v4)];
  const int before = squared(d1) + squared(d2) + squared(d3) + squared(d4);
  const int after = squared(d1 - 1) + squared(d2 + 1) + squared(d3 - 1) + squared(d4 + 1);
  if (after != before) return after < before;
  return vector_between(mesh, around.v4, around.v2).norm() <
         shorter * vector_between(mesh, around.v3, around.v1).norm();
}

}  // namespace

std::vector<int> valence_deviations(const TriMesh& mesh) {
  std::vector<int> deviations(mesh.n_vertices());
  for (const auto v : mesh.vertices()) deviations[index(v)] = v.is_boundary() ? -4 : -6;
  for (const auto e : mesh.edges()) {
    ++deviations[index(e.v0())];
    ++deviations[index(e.v1())];
  }
  return deviations;
}

EdgeNeighborhood neighborhood_of(const TriMesh& mesh, EdgeHandle e) {
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  const HalfedgeHandle o = mesh.halfedge_handle(e, 1);
  return {mesh.from_vertex_handle(h), mesh.to_vertex_handle(mesh.next_halfedge_handle(o)),
          mesh.to_vertex_handle(h), mesh.to_vertex_handle(mesh.next_halfedge_handle(h))};
}

int correct_valences(ConstrainedMesh& constrained) {
  TriMesh& mesh = constrained.mesh;
  std::vector<int> deviations = valence_deviations(mesh);
  int flips = 0;
  for (int pass = 0; pass < passes; ++pass) {
    for (const auto e : mesh.edges()) {
      if (e.is_boundary() || constrained.curve_of(e)) continue;
      const EdgeNeighborhood around = neighborhood_of(mesh, e);
      if (!flip_improves(mesh, around, deviations)) continue;
      if (!constrained.flip(e)) continue;
      --deviations[index(around.v1)];
      --deviations[index(around.v3)];
      ++deviations[index(around.v2)];
      ++deviations[index(around.v4)];
      ++flips;
    }
  }
  return flips;
}

}  // namespace trivalent::remesh
