#include "trivalent/dual/build_dual.h"

#include <algorithm>
#include <cmath>

#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

std::vector<Eigen::Vector3d> centroids(const remesh::TriMesh& mesh) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(mesh.n_faces());
  for (const auto face : mesh.faces()) positions.push_back(mesh.calc_face_centroid(face));
  return positions;
}

std::vector<std::array<int, 2>> bonds_across_edges(const remesh::TriMesh& mesh) {
  std::vector<std::array<int, 2>> bonds;
  bonds.reserve(mesh.n_edges());
  for (const auto edge : mesh.edges()) {
    if (edge.is_boundary()) continue;
    const int left = edge.h0().face().idx();
    const int right = edge.h1().face().idx();
    bonds.push_back({std::min(left, right), std::max(left, right)});
  }
  return bonds;
}

std::vector<std::vector<int>> rings_around_vertices(const remesh::TriMesh& mesh) {
  std::vector<std::vector<int>> rings;
  rings.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    if (vertex.is_boundary()) continue;
    std::vector<int> ring;
    for (const auto face : mesh.vf_ccw_range(vertex)) ring.push_back(face.idx());
    if (ring.size() < 3) {
      throw InvalidNetwork(concat("build_dual: vertex ", vertex.idx(), " has valence ", ring.size(),
                                  "; rings need 3 or more atoms; remesh first"));
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

double edge_length_for_bond(double bond) { return std::sqrt(3.0) * bond; }

Network build_dual(const remesh::TriMesh& mesh) {
  if (mesh.n_faces() == 0)
    throw InvalidNetwork("build_dual: the mesh has no faces; atoms need them");
  return {.positions = centroids(mesh),
          .bonds = bonds_across_edges(mesh),
          .rings = rings_around_vertices(mesh)};
}

double mean_bond_length(const Network& network) {
  if (network.bonds.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& [first, second] : network.bonds) {
    sum += (network.positions[first] - network.positions[second]).norm();
  }
  return sum / static_cast<double>(network.bonds.size());
}

}  // namespace trivalent::dual
