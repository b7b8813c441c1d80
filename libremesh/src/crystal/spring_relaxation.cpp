#include "crystal/spring_relaxation.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "equalize/sliding.h"
#include "mesh/adjacency.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Where the vertices go in so many sweeps, all in the tangent planes of where they are.
std::vector<Eigen::Vector3d> positions_after(const ConstrainedMesh& constrained,
                                             const IndexLists& around, double length, int sweeps) {
  const std::vector<MotionFrame> frames = motion_frames(constrained);
  const Lattice& lattice = constrained.mesh.lattice;
  std::vector<Eigen::Vector3d> positions(frames.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = constrained.mesh.point(VertexHandle(static_cast<int>(i)));
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (frames[i].freedoms == 0) continue;
      SpringStep step(frames[i]);
      for (const int j : around[i]) {
        step.add_edge(lattice.nearest(positions[static_cast<std::size_t>(j)] - positions[i]),
                      length);
      }
      positions[i] += step.displacement(length);
    }
  }
  return positions;
}

}  // namespace

std::vector<MotionFrame> motion_frames(const ConstrainedMesh& constrained) {
  std::vector<MotionFrame> frames(constrained.mesh.n_vertices());
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    const VertexHandle v(static_cast<int>(i));
    if (constrained.mesh.status(v).deleted()) return;
    frames[i] = motion_frame(constrained, constrained.mesh.point(v), constrained.anchor(v));
  });
  return frames;
}

void relax_springs(ConstrainedMesh& constrained, double length, int sweeps,
                   const std::function<bool()>& should_stop) {
  constexpr int sweeps_per_slide = 5;  // tangent planes and springs' far ends are then still right
  const IndexLists around = one_rings(constrained.mesh);
  for (int done = 0; done < sweeps; done += sweeps_per_slide) {
    slide_vertices(constrained, positions_after(constrained, around, length,
                                                std::min(sweeps_per_slide, sweeps - done)));
    if (should_stop && should_stop()) return;
  }
}

void settle_springs(ConstrainedMesh& constrained, double length, int sweeps) {
  TriMesh& mesh = constrained.mesh;
  const std::vector<Eigen::Vector3d> positions =
      positions_after(constrained, one_rings(mesh), length, sweeps);
  for (const auto v : mesh.vertices()) {
    if (constrained.anchor(v).kind == FeatureKind::none) mesh.point(v) = positions[index(v)];
  }
}

double spring_strain(const TriMesh& mesh, double length) {
  double count = 0.0;
  double sum = 0.0;
  for (const auto e : mesh.edges()) {
    const double stretch = edge_length(mesh, e) / length - 1.0;
    sum += stretch * stretch;
    count += 1.0;
  }
  return sum / count;
}

}  // namespace trivalent::remesh
