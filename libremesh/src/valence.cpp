#include "valence.h"

#include "face_guard.h"

namespace trivalent::remesh {

namespace {

/// A flip makes others worthwhile; a second pass takes them up, further ones find next to nothing.
constexpr int passes = 2;
/// The flipped edge must be shorter than this part of the old one to break a tie, so that no edge
/// flips back and forth for a rounding error.
constexpr double shorter = 0.99;

/// Flipping takes an edge from both ends and gives one to both opposite vertices.
bool flip_improves(const TriMesh& mesh, EdgeHandle e) {
  const auto [v1, v2, v3, v4] = neighborhood_of(mesh, e);
  const int before = irregularity(mesh, v1, 0) + irregularity(mesh, v2, 0) +
                     irregularity(mesh, v3, 0) + irregularity(mesh, v4, 0);
  const int after = irregularity(mesh, v1, -1) + irregularity(mesh, v2, 1) +
                    irregularity(mesh, v3, -1) + irregularity(mesh, v4, 1);
  if (after != before) return after < before;
  return (mesh.point(v2) - mesh.point(v4)).norm() <
         shorter * (mesh.point(v1) - mesh.point(v3)).norm();
}

}  // namespace

int irregularity(const TriMesh& mesh, VertexHandle v, int change) {
  const int wanted = mesh.is_boundary(v) ? 4 : 6;
  const int deviation = static_cast<int>(mesh.valence(v)) + change - wanted;
  return deviation * deviation;
}

EdgeNeighborhood neighborhood_of(const TriMesh& mesh, EdgeHandle e) {
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  const HalfedgeHandle o = mesh.halfedge_handle(e, 1);
  return {mesh.from_vertex_handle(h), mesh.to_vertex_handle(mesh.next_halfedge_handle(o)),
          mesh.to_vertex_handle(h), mesh.to_vertex_handle(mesh.next_halfedge_handle(h))};
}

int correct_valences(ConstrainedMesh& constrained) {
  TriMesh& mesh = constrained.mesh;
  int flips = 0;
  for (int pass = 0; pass < passes; ++pass) {
    for (const auto e : mesh.edges()) {
      if (e.is_boundary() || constrained.curve_of(e)) continue;
      if (!flip_improves(mesh, e) || !mesh.is_flip_ok(e) || !flip_stays_upright(mesh, e)) continue;
      mesh.flip(e);
      ++flips;
    }
  }
  return flips;
}

}  // namespace trivalent::remesh
