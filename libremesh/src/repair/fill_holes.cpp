#include "repair/fill_holes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "mesh/adjacency.h"

namespace trivalent::remesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Triangles that fill a loop, as positions in it; none if there is no way.
std::vector<std::array<int, 3>> patch_for(const TriMesh& mesh,
                                          const std::vector<VertexHandle>& loop) {
  std::vector<Kernel::Point_3> points;
  points.reserve(loop.size());
  for (const VertexHandle v : loop) {
    const Eigen::Vector3d& p = mesh.point(v);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<CGAL::Triple<int, int, int>> triples;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(points, std::back_inserter(triples));
  std::vector<std::array<int, 3>> patch;
  patch.reserve(triples.size());
  for (const auto& t : triples) patch.push_back({t.first, t.second, t.third});
  return patch;
}

/// An edge of the patch that the mesh has elsewhere would get more than two faces.
bool fits(const TriMesh& mesh, const std::vector<VertexHandle>& loop,
          const std::vector<std::array<int, 3>>& patch) {
  const int last = static_cast<int>(loop.size()) - 1;
  return std::all_of(patch.begin(), patch.end(), [&](const std::array<int, 3>& triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      const bool along_the_loop = high == low + 1 || (low == 0 && high == last);
      if (along_the_loop) continue;
      const VertexHandle a = loop[static_cast<std::size_t>(low)];
      const VertexHandle b = loop[static_cast<std::size_t>(high)];
      if (mesh.find_halfedge(a, b).is_valid()) return false;
    }
    return true;
  });
}

void add_fan(TriMesh& mesh, const std::vector<VertexHandle>& loop) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const VertexHandle v : loop) sum += mesh.point(v);
  const auto center = mesh.add_vertex(sum / static_cast<double>(loop.size()));
  for (std::size_t k = 0; k < loop.size(); ++k) {
    mesh.add_face(loop[k], loop[(k + 1) % loop.size()], center);
  }
}

}  // namespace

int fill_holes(TriMesh& mesh) {
  const auto loops = boundary_loops(mesh);
  for (const auto& loop : loops) {
    const auto patch = patch_for(mesh, loop);
    if (patch.empty() || !fits(mesh, loop, patch)) {
      add_fan(mesh, loop);
      continue;
    }
    for (const auto& [a, b, c] : patch) {
      mesh.add_face(loop[static_cast<std::size_t>(a)], loop[static_cast<std::size_t>(b)],
                    loop[static_cast<std::size_t>(c)]);
    }
  }
  return static_cast<int>(loops.size());
}

}  // namespace trivalent::remesh
