#include "crystal/defect_moves.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace trivalent::remesh {

double largest_rise(double temperature, std::uint64_t random, double min_gain) {
  return temperature > 0.0 ? -temperature * std::log(1.0 - uniform(random)) : -min_gain;
}

std::vector<DefectMove> shuffled_moves(int valence, std::uint64_t seed) {
  using Kind = DefectMove::Kind;
  std::vector<DefectMove> moves;
  for (int k = 0; k < valence; ++k) {
    for (const Kind kind : {Kind::flip_spoke, Kind::flip_rim, Kind::collapse, Kind::split}) {
      moves.push_back({kind, k});
    }
  }
  for (std::size_t left = moves.size(); left > 1; --left) {
    seed = hashed(seed, 2);
    std::swap(moves[left - 1], moves[seed % left]);
  }
  return moves;
}

namespace {

/// Marks the vertices of a patch as taken, unless one of them is already.
bool claim(const TriMesh& mesh, VertexHandle center, int rings, std::vector<bool>& taken,
           PatchMarks& marks) {
  std::vector<VertexHandle> patch = {center};
  marks.begin(mesh.n_vertices());
  marks.set(center, 0);
  std::size_t begin = 0;
  for (int ring = 0; ring <= rings; ++ring) {
    const std::size_t end = patch.size();
    for (; begin < end; ++begin) {
      if (taken[index(patch[begin])]) return false;
      for (const auto neighbor : mesh.vv_range(patch[begin])) {
        if (marks.number(neighbor) >= 0) continue;
        marks.set(neighbor, 0);
        patch.push_back(neighbor);
      }
    }
  }
  // Fixed vertices may be shared: only what moves is taken, together with what holds it.
  for (std::size_t i = 0; i < begin; ++i) taken[index(patch[i])] = true;
  return true;
}

/// Collapses an edge. Each face beside it becomes an edge, which lies along a curve if the kept
/// vertex's side of the face did.
void collapse(ConstrainedMesh& constrained, HalfedgeHandle h) {
  TriMesh& mesh = constrained.mesh;
  const VertexHandle kept = mesh.to_vertex_handle(h);
  std::vector<std::pair<VertexHandle, std::optional<int>>> curves;
  for (const HalfedgeHandle side : {h, mesh.opposite_halfedge_handle(h)}) {
    if (mesh.is_boundary(side)) continue;
    const VertexHandle third = mesh.to_vertex_handle(mesh.next_halfedge_handle(side));
    const EdgeHandle e = mesh.edge_handle(mesh.find_halfedge(kept, third));
    curves.emplace_back(third, constrained.curve_of(e));
  }
  mesh.collapse(h);
  for (const auto& [third, curve] : curves) {
    constrained.set_curve(mesh.edge_handle(mesh.find_halfedge(kept, third)), curve);
  }
}

}  // namespace

std::vector<VertexHandle> disjoint_sites(const TriMesh& mesh, const std::vector<int>& deviations,
                                         const SiteChoice& choice) {
  std::vector<std::pair<std::uint64_t, VertexHandle>> irregular;
  for (const auto v : mesh.vertices()) {
    if (std::abs(deviations[index(v)]) < choice.min_deviation) continue;
    const std::uint64_t random = hashed(choice.seed, static_cast<std::uint64_t>(v.idx()));
    const std::uint64_t rounds = choice.rounds_per_boundary;
    if (v.is_boundary() && (rounds == 0 || random % rounds != 0)) continue;
    irregular.emplace_back(random, v);
  }
  std::sort(irregular.begin(), irregular.end());
  std::vector<VertexHandle> sites;
  std::vector<bool> taken(mesh.n_vertices(), false);
  PatchMarks marks;
  for (const auto& [key, v] : irregular) {
    if (claim(mesh, v, choice.rings, taken, marks)) sites.push_back(v);
  }
  return sites;
}

std::vector<VertexHandle> change_connectivity(ConstrainedMesh& constrained,
                                              const PatchTopology& topology) {
  TriMesh& mesh = constrained.mesh;
  std::vector<VertexHandle> vertices;
  vertices.reserve(static_cast<std::size_t>(topology.size()));
  for (int i = 0; i < topology.size(); ++i) vertices.push_back(topology.vertex(i));
  for (const PatchChange& change : topology.changes()) {
    const HalfedgeHandle h = mesh.find_halfedge(vertices[change.from], vertices[change.to]);
    switch (change.kind) {
      case PatchChange::Kind::flip:
        mesh.flip(mesh.edge_handle(h));
        break;
      case PatchChange::Kind::collapse:
        collapse(constrained, h);
        break;
      case PatchChange::Kind::split: {
        const std::optional<int> curve = constrained.curve_of(mesh.edge_handle(h));
        const VertexHandle added = mesh.split(mesh.edge_handle(h), Eigen::Vector3d(0.0, 0.0, 0.0));
        vertices[static_cast<std::size_t>(topology.added())] = added;
        for (const auto spoke : mesh.ve_range(added)) {
          constrained.set_curve(spoke, spoke.is_boundary() ? curve : std::nullopt);
        }
        break;
      }
    }
  }
  return vertices;
}

}  // namespace trivalent::remesh
