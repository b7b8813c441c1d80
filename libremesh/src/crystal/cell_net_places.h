#pragma once

#include <Eigen/Core>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Places on a surface for the vertices of a net that has few.
struct CellNetPlaces {
  int saddles;     ///< so many first: where the Gaussian curvature is least, and octagons belong
  int all;         ///< the others: each as far as possible from all before it
  double spacing;  ///< of neighbors, about [mesh's unit]; saddles are not much nearer to each other
};

/// @param surface  Of triangles much smaller than the spacing, without a boundary.
/// @return         Vertices of the surface: fewer than asked for if it has no more.
[[nodiscard]] std::vector<Eigen::Vector3d> find_places(const TriMesh& surface,
                                                       const CellNetPlaces& wanted);

}  // namespace trivalent::remesh
