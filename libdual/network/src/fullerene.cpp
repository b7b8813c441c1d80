#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "even_out.h"
#include "ideal_edges.h"
#include "lattice_polyhedron.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/ideal_structures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::dual {
namespace {

/// The vector along an edge of a triangulated icosahedron whose faces have norm(vector) = T
/// triangles each.
std::optional<LatticeVector> edge_vector(int triangulation_number) {
  const int most = static_cast<int>(std::lround(std::sqrt(triangulation_number))) + 1;
  for (int k = 0; k <= most; ++k) {
    for (int h = most; h >= k; --h) {
      const LatticeVector vector = {h, k};
      if (norm(vector) == triangulation_number) return vector;
    }
  }
  return std::nullopt;
}

/// The icosahedron whose edges are this vector, triangulated and projected on a sphere.
remesh::TriMesh triangulated_icosahedron(LatticeVector edge, double radius) {
  constexpr double edge_length = 1.2;  // as long as its own: the coarsest triangulation
  const remesh::TriMesh icosahedron = remesh::make_shape("sphere", {}, edge_length);
  std::vector<LatticeFace> faces;
  for (const auto f : icosahedron.faces()) {
    LatticeFace& face = faces.emplace_back();
    std::ranges::transform(f.vertices(), face.corners.begin(), [](auto v) { return v.idx(); });
    face.at = {LatticeVector{0, 0}, edge, sixth_turn * edge};
  }
  const LatticeTriangulation net = triangulate(faces);
  std::vector<Eigen::Vector3d> points;
  for (const auto& [f, at] : net.vertices) {
    const std::array<double, 3> weights = faces[f].weights(at);
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      point += weights[k] * icosahedron.point(remesh::VertexHandle(faces[f].corners[k]));
    }
    points.emplace_back(radius * point.normalized());
  }
  return remesh::make_mesh(points, net.triangles);
}

constexpr int atoms_per_triangulation_number = 20;

[[noreturn]] void refuse(int n_atoms) {
  const int wanted =
      std::max(n_atoms, atoms_per_triangulation_number) / atoms_per_triangulation_number;
  int below = wanted;
  while (!edge_vector(below)) --below;
  int above = wanted + 1;
  while (!edge_vector(above)) ++above;
  throw InvalidOption(concat("fullerene: there is no icosahedral fullerene of ", n_atoms,
                             " atoms; the nearest have ", atoms_per_triangulation_number * below,
                             " and ", atoms_per_triangulation_number * above,
                             " (build sphere --atoms N makes cages of any number)"));
}

}  // namespace

Structure icosahedral_fullerene(int n_atoms) {
  require_few_atoms("fullerene", n_atoms);
  if (n_atoms < atoms_per_triangulation_number || n_atoms % atoms_per_triangulation_number != 0) {
    refuse(n_atoms);
  }
  const auto vector = edge_vector(n_atoms / atoms_per_triangulation_number);
  if (!vector) refuse(n_atoms);
  const double area_per_atom = 0.75 * std::numbers::sqrt3 * graphene_bond * graphene_bond;
  const double radius = std::sqrt(n_atoms * area_per_atom / (4.0 * std::numbers::pi));
  Structure structure = build_dual(triangulated_icosahedron(*vector, radius));
  even_out(structure, [radius](const Eigen::Vector3d& position) {
    return Eigen::Vector3d(radius * position.normalized());
  });
  return structure;
}

Structure icosahedral_onion(int n_walls) {
  constexpr int max_walls = 30;
  constexpr int innermost = 60;
  if (n_walls < 1 || n_walls > max_walls) {
    throw InvalidOption(concat("onion: ", n_walls, " walls; 1 to ", max_walls, " can be made"));
  }
  Structure onion;
  std::vector<int> walls;
  for (int wall = 0; wall < n_walls; ++wall) {
    const Structure cage = icosahedral_fullerene(innermost * (wall + 1) * (wall + 1));
    const auto first = static_cast<std::uint32_t>(onion.atoms.size());
    std::ranges::copy(cage.atoms.positions, std::back_inserter(onion.atoms.positions));
    for (const potentials::Bond& bond : cage.bonds) {
      onion.bonds.push_back({.first = bond.first + first, .second = bond.second + first});
    }
    for (Ring ring : cage.rings) {
      for (int& atom : ring.atoms) atom += static_cast<int>(first);
      onion.rings.push_back(std::move(ring));
    }
    walls.resize(onion.atoms.size(), wall);
  }
  onion.atoms.species.assign(onion.atoms.size(), potentials::Species::carbon);
  onion.columns.push_back({.name = "wall", .values = std::move(walls)});
  return onion;
}

}  // namespace trivalent::dual
