#include "trivalent/dual/build_dual.h"

#include <algorithm>
#include <cmath>

#include "trivalent/dual/error.h"
#include "trivalent/dual/padded_box.h"

namespace trivalent::dual {
namespace {

/// The image of an atom that is nearest to another one.
remesh::Lattice::Image image_beside(const remesh::Lattice& lattice,
                                    const std::vector<Eigen::Vector3d>& positions, std::size_t atom,
                                    std::size_t other) {
  const Eigen::Vector3d separation = positions[other] - positions[atom];
  return lattice.image_of(lattice.nearest(separation) - separation);
}

std::vector<potentials::Bond> bonds_across_edges(const remesh::TriMesh& mesh,
                                                 const std::vector<Eigen::Vector3d>& positions) {
  std::vector<potentials::Bond> bonds;
  bonds.reserve(mesh.n_edges());
  for (const auto edge : mesh.edges()) {
    if (edge.is_boundary()) continue;
    const auto left = static_cast<std::uint32_t>(edge.h0().face().idx());
    const auto right = static_cast<std::uint32_t>(edge.h1().face().idx());
    potentials::Bond bond{std::min(left, right), std::max(left, right)};
    bond.image = image_beside(mesh.lattice, positions, bond.first, bond.second);
    bonds.push_back(bond);
  }
  return bonds;
}

/// Cells of a ring's atoms, counted from the first one's; empty if they are the same.
std::vector<remesh::Lattice::Image> images_around(const remesh::Lattice& lattice,
                                                  const std::vector<Eigen::Vector3d>& positions,
                                                  const std::vector<int>& atoms) {
  const remesh::Lattice::Image home = {0, 0, 0};
  std::vector<remesh::Lattice::Image> images = {home};
  bool crosses_boundary = false;
  for (std::size_t k = 1; k < atoms.size(); ++k) {
    remesh::Lattice::Image image =
        image_beside(lattice, positions, static_cast<std::size_t>(atoms[k - 1]),
                     static_cast<std::size_t>(atoms[k]));
    for (std::size_t axis = 0; axis < 3; ++axis) image[axis] += images.back()[axis];
    crosses_boundary = crosses_boundary || image != home;
    images.push_back(image);
  }
  if (!crosses_boundary) images.clear();
  return images;
}

std::vector<Ring> rings_around_vertices(const remesh::TriMesh& mesh,
                                        const std::vector<Eigen::Vector3d>& positions) {
  std::vector<Ring> rings;
  rings.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    if (vertex.is_boundary()) continue;
    Ring ring;
    for (const auto face : mesh.vf_ccw_range(vertex)) ring.atoms.push_back(face.idx());
    if (mesh.lattice.is_periodic()) {
      ring.images = images_around(mesh.lattice, positions, ring.atoms);
    }
    if (ring.atoms.size() < 3) {
      throw InvalidNetwork(concat("build_dual: vertex ", vertex.idx(), " has valence ",
                                  ring.atoms.size(), "; rings need 3 or more atoms; remesh first"));
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

double edge_length_for_bond(double bond) { return std::sqrt(3.0) * bond; }

Structure build_dual(const remesh::TriMesh& mesh) {
  if (mesh.n_faces() == 0)
    throw InvalidNetwork("build_dual: the mesh has no faces; atoms need them");
  // Member by member: gcc 12 destroys a nested initializer twice if a later one throws.
  Structure structure;
  structure.atoms.positions = remesh::face_centroids(mesh);
  structure.atoms.species.assign(mesh.n_faces(), potentials::Species::carbon);
  structure.bonds = bonds_across_edges(mesh, structure.atoms.positions);
  structure.rings = rings_around_vertices(mesh, structure.atoms.positions);
  if (mesh.lattice.is_periodic()) {
    structure.atoms.box =
        periodic_box({.cell = mesh.lattice.cell(), .periodic = mesh.lattice.periodic()},
                     structure.atoms.positions);
  }
  return structure;
}

double mean_bond_length(const Structure& structure) {
  if (structure.bonds.empty()) return 0.0;
  double sum = 0.0;
  for (const potentials::Bond& bond : structure.bonds) {
    sum += potentials::bond_length(structure.atoms, bond);
  }
  return sum / static_cast<double>(structure.bonds.size());
}

}  // namespace trivalent::dual
