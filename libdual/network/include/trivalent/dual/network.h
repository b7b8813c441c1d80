#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace trivalent::dual {

/// A network of atoms, bonds and rings: the dual of a triangle mesh.
struct Network {
  std::vector<Eigen::Vector3d> positions = {};  ///< one atom per mesh face [Å]
  std::vector<std::array<int, 2>> bonds =
      {};  ///< atom indices, first < second; one per interior edge
  std::vector<std::vector<int>> rings = {};  ///< atoms in order, one ring per interior mesh vertex
  int hydrogens = 0;  ///< so many of the last atoms are hydrogen, all others carbon
};

}  // namespace trivalent::dual
