#include "crystal/thin_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <vector>

#include "equalize/relaxation.h"
#include "equalize/sliding.h"
#include "equalize/stellar.h"
#include "equalize/valence.h"
#include "mesh/geometry.h"
#include "mesh/self_intersections.h"

namespace trivalent::remesh {

namespace {

bool looks_inwards(const ConstrainedMesh& constrained, FaceHandle f) {
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
  for (const auto v : constrained.mesh.fv_range(f)) outward += constrained.normal(v);
  return face_normal(constrained.mesh, f).dot(outward) < 0.0;
}

/// The free vertices of faces that look inwards, in order.
std::vector<VertexHandle> folded_vertices(const ConstrainedMesh& constrained) {
  std::vector<VertexHandle> folded;
  for (const auto f : constrained.mesh.faces()) {
    if (!looks_inwards(constrained, f)) continue;
    for (const auto v : f.vertices()) {
      if (constrained.anchor(v).kind == FeatureKind::none) folded.push_back(v);
    }
  }
  std::sort(folded.begin(), folded.end());
  folded.erase(std::unique(folded.begin(), folded.end()), folded.end());
  return folded;
}

double squared_distance(const TriMesh& mesh, VertexHandle v, const Eigen::Vector3d& p) {
  return mesh.lattice.nearest(mesh.point(v) - p).squaredNorm();
}

/// The vertex of a face that is nearest to p.
VertexHandle nearest_corner(const TriMesh& mesh, int face, const Eigen::Vector3d& p) {
  VertexHandle nearest;
  for (const auto v : mesh.fv_range(FaceHandle(face))) {
    if (!nearest.is_valid() || squared_distance(mesh, v, p) < squared_distance(mesh, nearest, p)) {
      nearest = v;
    }
  }
  return nearest;
}

/// Moves the nearest vertices of the net to vertices of the surface farther away than `far`.
///
/// @return Number of vertices moved.
int reach_tips(ConstrainedMesh& constrained, const TriMesh& surface, double far) {
  TriMesh& mesh = constrained.mesh;
  struct Tip {
    VertexHandle on_surface;
    double distance;
  };
  std::vector<Tip> tips(mesh.n_vertices(), {VertexHandle(), far});  // farthest, for each vertex
  const SurfaceProjector net(mesh);
  for (const auto v : surface.vertices()) {
    const Eigen::Vector3d& p = surface.point(v);
    const SurfacePoint foot = net.nearest(p);
    const double distance = (foot.position - p).norm();
    if (distance <= far) continue;
    Tip& tip = tips[index(nearest_corner(mesh, foot.face, p))];
    if (distance > tip.distance) tip = {v, distance};
  }
  int moved = 0;
  for (const auto v : mesh.vertices()) {
    const VertexHandle tip = tips[index(v)].on_surface;
    Anchor anchor = constrained.anchor(v);
    if (!tip.is_valid() || anchor.kind != FeatureKind::none) continue;
    anchor.face = surface.cvf_begin(tip)->idx();
    mesh.point(v) = surface.point(tip);
    constrained.set_anchor(v, anchor);
    ++moved;
  }
  return moved;
}

/// Direction from the sheet of face b to that of face a, where the faces cross.
Eigen::Vector3d direction_between(const ConstrainedMesh& constrained, const std::array<int, 3>& a,
                                  const std::array<int, 3>& b) {
  const TriMesh& mesh = constrained.mesh;
  const Eigen::Vector3d& here = mesh.point(VertexHandle(a[0]));
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (const auto& face : {a, b}) {
    for (const int v : face) place += mesh.lattice.near(here, mesh.point(VertexHandle(v))) / 6.0;
  }
  const auto foot = [&](const std::array<int, 3>& face) {
    return constrained.surface().walk_towards(place,
                                              constrained.anchor(VertexHandle(face[0])).face);
  };
  const SurfacePoint on_a = foot(a);
  const SurfacePoint on_b = foot(b);
  const Eigen::Vector3d apart =
      (constrained.surface().normal(on_a) - constrained.surface().normal(on_b)).normalized();
  // Sheets look away from each other across a wall, and at each other across a gap.
  return apart.dot(on_a.position - on_b.position) >= 0.0 ? apart : Eigen::Vector3d(-apart);
}

Eigen::Vector3d middle_of_neighbors(const TriMesh& mesh, VertexHandle v) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto neighbor : mesh.vv_range(v)) sum += position_beside(mesh, v, neighbor);
  return sum / mesh.valence(v);
}

/// The free vertices of crossing faces and their neighbors, in order.
std::vector<VertexHandle> free_vertices_near(const ConstrainedMesh& constrained,
                                             const CrossingFaces& crossing) {
  const TriMesh& mesh = constrained.mesh;
  std::vector<VertexHandle> corners;
  for (const auto& pair : crossing.first) {
    for (const int f : pair) {
      for (const auto v : mesh.fv_range(FaceHandle(f))) corners.push_back(v);
    }
  }
  std::vector<VertexHandle> near = corners;
  for (const VertexHandle v : corners) {
    for (const auto neighbor : mesh.vv_range(v)) near.push_back(neighbor);
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::erase_if(near,
                [&](VertexHandle v) { return constrained.anchor(v).kind != FeatureKind::none; });
  return near;
}

}  // namespace

void unfold(ConstrainedMesh& constrained) {
  constexpr int max_steps = 20;
  TriMesh& mesh = constrained.mesh;
  for (int i = 0; i < max_steps; ++i) {
    const std::vector<VertexHandle> folded = folded_vertices(constrained);
    if (folded.empty()) return;
    for (const VertexHandle v : folded) {
      Anchor anchor = constrained.anchor(v);
      mesh.point(v) = constrained.project(middle_of_neighbors(mesh, v), anchor);
      constrained.set_anchor(v, anchor);
    }
  }
}

void mend_thin_parts(ConstrainedMesh& constrained, const TriMesh& surface, double length) {
  constexpr int max_rounds = 5;
  constexpr double far = 0.6;  // of the length
  // Springs and annealing bring the edges in between to the length.
  const StellarLimits limits = {.target = length,
                                .shortest = 0.6 * length,
                                .longest = 1.5 * length,
                                .overlong = 1.6 * length,
                                .mends_valences = false};
  for (int round = 0; round < max_rounds; ++round) {
    unfold(constrained);
    const int moved = reach_tips(constrained, surface, far * length);
    if (apply_stellar_operations(constrained, limits) + moved == 0) return;
    correct_valences(constrained);
    slide_vertices(constrained, relaxed_positions(constrained, RelaxationOptions{}));
  }
}

void part_sheets(ConstrainedMesh& constrained) {
  constexpr int max_steps = 20;
  constexpr double step = 0.02;  // of the mean edge
  TriMesh& mesh = constrained.mesh;
  const double size = step * mean_edge_length(mesh);
  const std::vector<std::array<int, 3>> faces = triangles_of(mesh);
  for (int i = 0; i < max_steps; ++i) {
    const CrossingFaces crossing = find_crossing_faces(mesh, faces.size());
    if (crossing.count == 0) return;
    std::vector<Eigen::Vector3d> pushes(mesh.n_vertices(), Eigen::Vector3d::Zero());
    for (const auto& [a, b] : crossing.first) {
      const auto& face_a = faces[static_cast<std::size_t>(a)];
      const auto& face_b = faces[static_cast<std::size_t>(b)];
      const Eigen::Vector3d direction = direction_between(constrained, face_a, face_b);
      for (const int v : face_a) pushes[static_cast<std::size_t>(v)] += direction;
      for (const int v : face_b) pushes[static_cast<std::size_t>(v)] -= direction;
    }
    for (const auto v : mesh.vertices()) {
      if (constrained.anchor(v).kind != FeatureKind::none) continue;
      if (pushes[index(v)].norm() > 0.5) mesh.point(v) += size * pushes[index(v)].normalized();
    }
  }
}

void smooth_crossings(ConstrainedMesh& constrained, const std::function<bool()>& should_stop) {
  constexpr int max_idle_steps = 20;
  TriMesh& mesh = constrained.mesh;
  const std::size_t all = mesh.n_faces();
  CrossingFaces crossing = find_crossing_faces(mesh, all);
  std::vector<Eigen::Vector3d> best(mesh.points(), mesh.points() + mesh.n_vertices());
  std::size_t fewest = crossing.count;
  for (int idle = 0; idle < max_idle_steps && crossing.count > 0; ++idle) {
    if (should_stop && should_stop()) break;
    for (const VertexHandle v : free_vertices_near(constrained, crossing)) {
      mesh.point(v) = 0.5 * (mesh.point(v) + middle_of_neighbors(mesh, v));
    }
    crossing = find_crossing_faces(mesh, all);
    if (crossing.count >= fewest) continue;
    fewest = crossing.count;
    idle = 0;
    best.assign(mesh.points(), mesh.points() + mesh.n_vertices());
  }
  for (const auto v : mesh.vertices()) mesh.point(v) = best[index(v)];
}

}  // namespace trivalent::remesh
