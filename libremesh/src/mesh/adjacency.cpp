#include "mesh/adjacency.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace trivalent::remesh {

IndexLists one_rings(const TriMesh& mesh) {
  IndexLists rings;
  rings.begin.reserve(mesh.n_vertices() + 1);
  rings.items.reserve(2 * mesh.n_edges());
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) {
    rings.begin.push_back(static_cast<int>(rings.items.size()));
    const VertexHandle v(static_cast<int>(i));
    if (mesh.status(v).deleted()) continue;
    for (const auto neighbor : mesh.vv_range(v)) rings.items.push_back(neighbor.idx());
  }
  rings.begin.push_back(static_cast<int>(rings.items.size()));
  return rings;
}

IndexLists triangles_at_vertices(std::span<const std::array<int, 3>> triangles,
                                 std::size_t n_vertices) {
  IndexLists lists;
  lists.begin.assign(n_vertices + 1, 0);
  for (const auto& triangle : triangles) {
    for (const int v : triangle) ++lists.begin[static_cast<std::size_t>(v) + 1];
  }
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.items.resize(3 * triangles.size());
  std::vector<int> next = lists.begin;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int v : triangles[t]) {
      lists.items[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] =
          static_cast<int>(t);
    }
  }
  return lists;
}

FacesByComponent faces_by_component(const TriMesh& mesh) {
  FacesByComponent walk;
  walk.faces.reserve(mesh.n_faces());
  std::vector<char> is_seen(mesh.n_faces(), 0);
  const auto visit = [&](FaceHandle face) {
    if (std::exchange(is_seen[static_cast<std::size_t>(face.idx())], 1) == 0)
      walk.faces.push_back(face);
  };
  for (const auto start : mesh.faces()) {
    const std::size_t begin = walk.faces.size();
    visit(start);
    for (std::size_t i = begin; i < walk.faces.size(); ++i) {
      for (const auto next : mesh.ff_range(walk.faces[i])) visit(next);
    }
    if (walk.faces.size() > begin) walk.ends.push_back(walk.faces.size());
  }
  return walk;
}

bool has_boundary(const TriMesh& mesh) {
  return std::ranges::any_of(mesh.edges(), [](const auto e) { return e.is_boundary(); });
}

std::vector<std::vector<VertexHandle>> boundary_loops(const TriMesh& mesh) {
  std::vector<std::vector<VertexHandle>> loops;
  std::vector<char> is_seen(mesh.n_halfedges(), 0);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || is_seen[static_cast<std::size_t>(start.idx())] != 0) continue;
    loops.emplace_back();
    HalfedgeHandle h = start;
    while (std::exchange(is_seen[static_cast<std::size_t>(h.idx())], 1) == 0) {
      loops.back().push_back(mesh.from_vertex_handle(h));
      h = mesh.next_halfedge_handle(h);
    }
  }
  return loops;
}

}  // namespace trivalent::remesh
