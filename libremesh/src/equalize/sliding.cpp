#include "equalize/sliding.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Of a face whose vertices are at these places, or images of them.
Eigen::Vector3d area_vector(const std::array<int, 3>& face, const std::vector<Eigen::Vector3d>& at,
                            const Lattice& lattice) {
  const Eigen::Vector3d& a = at[static_cast<std::size_t>(face[0])];
  return doubled_area_vector(a, lattice.near(a, at[static_cast<std::size_t>(face[1])]),
                             lattice.near(a, at[static_cast<std::size_t>(face[2])]));
}

/// Where all vertices are, and what the surface's normals are there; no normals if they do not
/// matter.
struct Placement {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;
};

/// Whether a face looks into the surface; across a tip it may look a little inwards.
bool looks_inwards(const std::array<int, 3>& face, const Placement& at, const Lattice& lattice) {
  constexpr double min_cosine = -0.3;
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
  for (const int v : face) outward += at.normals[static_cast<std::size_t>(v)];
  const Eigen::Vector3d area = area_vector(face, at.positions, lattice);
  return area.dot(outward) < min_cosine * area.norm() * outward.norm();
}

/// Vertices of faces that look the other way at `after` than at `before`, or no longer outwards.
std::vector<VertexHandle> turned_vertices(const std::vector<std::array<int, 3>>& faces,
                                          const Placement& before, const Placement& after,
                                          const Lattice& lattice) {
  std::vector<VertexHandle> turned;
  for (const auto& face : faces) {
    const bool turns = area_vector(face, before.positions, lattice)
                           .dot(area_vector(face, after.positions, lattice)) < 0.0;
    const bool turns_inwards = !after.normals.empty() && looks_inwards(face, after, lattice) &&
                               !looks_inwards(face, before, lattice);
    if (!turns && !turns_inwards) continue;
    for (const int v : face) turned.emplace_back(v);
  }
  std::sort(turned.begin(), turned.end());
  turned.erase(std::unique(turned.begin(), turned.end()), turned.end());
  return turned;
}

}  // namespace

void slide_vertices(ConstrainedMesh& constrained, const std::vector<Eigen::Vector3d>& targets) {
  TriMesh& mesh = constrained.mesh;
  const std::size_t n = mesh.n_vertices();
  Placement before{std::vector<Eigen::Vector3d>(n), {}};
  for (const auto v : mesh.vertices()) before.positions[index(v)] = mesh.point(v);
  if (constrained.stays_on_sheets()) {
    before.normals.resize(n);
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
      before.normals[i] = constrained.normal(VertexHandle(static_cast<int>(i)));
    });
  }
  Placement after = before;
  const auto project = [&](VertexHandle v, const Eigen::Vector3d& target) {
    Anchor anchor = constrained.anchor(v);
    if (anchor.kind == FeatureKind::corner) return;
    after.positions[index(v)] = constrained.project(target, anchor);
    constrained.set_anchor(v, anchor);
    if (!after.normals.empty()) {
      after.normals[index(v)] =
          constrained.surface().normal({after.positions[index(v)], anchor.face});
    }
  };
  tbb::parallel_for(std::size_t{0}, n,
                    [&](std::size_t i) { project(VertexHandle(static_cast<int>(i)), targets[i]); });

  constexpr int half_steps = 3;
  const std::vector<std::array<int, 3>> faces = triangles_of(mesh);
  for (int attempt = 0;; ++attempt) {
    const std::vector<VertexHandle> turned = turned_vertices(faces, before, after, mesh.lattice);
    if (turned.empty()) break;
    // A face whose three vertices stay does not turn, so this ends.
    for (const VertexHandle v : turned) {
      if (attempt < half_steps) {
        project(v, 0.5 * (before.positions[index(v)] + after.positions[index(v)]));
      } else {
        project(v, before.positions[index(v)]);  // for the anchor's sake
        after.positions[index(v)] = before.positions[index(v)];
        if (!before.normals.empty()) after.normals[index(v)] = before.normals[index(v)];
      }
    }
  }
  for (const auto v : mesh.vertices()) mesh.point(v) = after.positions[index(v)];
}

void straddle_surface(ConstrainedMesh& constrained) {
  // Over an equilateral chord of a sphere the mean depth is 3/4 of that at the centroid.
  constexpr double part_of_depth = 0.75;
  constexpr double longest = 0.2;  // of the mean edge: deeper is no chord, but a part not resolved
  TriMesh& mesh = constrained.mesh;
  const double limit = longest * mean_edge_length(mesh);
  const std::vector<std::array<int, 3>> faces = triangles_of(mesh);
  std::vector<Eigen::Vector3d> depths(faces.size());
  tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t f) {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const auto& corner : corners_of(mesh, FaceHandle(static_cast<int>(f))))
      centroid += corner / 3.0;
    const int near = constrained.anchor(VertexHandle(faces[f][0])).face;
    depths[f] = constrained.surface().nearest(centroid, near).position - centroid;
  });
  std::vector<Eigen::Vector3d> sums(mesh.n_vertices(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const int v : faces[f]) sums[static_cast<std::size_t>(v)] += depths[f];
  }
  for (const auto v : mesh.vertices()) {
    if (constrained.anchor(v).kind != FeatureKind::none) continue;
    const Eigen::Vector3d normal = constrained.normal(v);
    const double depth = sums[index(v)].dot(normal) / static_cast<double>(v.valence());
    mesh.point(v) += std::clamp(part_of_depth * depth, -limit, limit) * normal;
  }
}

}  // namespace trivalent::remesh
