#pragma once

#include <utility>
#include <vector>

#include "mesh_fixtures.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/dual_size.h"
#include "trivalent/dual/padded_box.h"

namespace testing_support {

inline trivalent::potentials::Atoms carbon_at(std::vector<Eigen::Vector3d> positions) {
  const std::vector species(positions.size(), trivalent::potentials::Species::carbon);
  return {.positions = std::move(positions), .species = species, .box = {}};
}

/// The dodecahedron with bonds of 1.45 Å.
inline trivalent::dual::Structure c20() {
  trivalent::remesh::TriMesh mesh = icosahedron();
  trivalent::remesh::scale(mesh, scale_for_size(mesh, trivalent::dual::MeanBond{1.45}));
  return trivalent::dual::build_dual(mesh);
}

/// The dual of the icosahedron of edge 2, in a box with a margin.
inline trivalent::dual::Structure boxed_c20() {
  trivalent::dual::Structure structure = trivalent::dual::build_dual(icosahedron());
  structure.atoms.box = trivalent::dual::padded_box(structure.atoms.positions);
  return structure;
}

}  // namespace testing_support
