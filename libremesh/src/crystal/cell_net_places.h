#pragma once

#include <Eigen/Core>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Places on a surface for the vertices of a net that has few.
struct CellNetPlaces {
  int saddles;     ///< how many, the first, lie where the Gaussian curvature is least
  int all;         ///< how many there are; after the saddles each is as far as possible from others
  double spacing;  ///< of neighbors, about [mesh's unit]; saddles are not much nearer to each other
};

/// @param surface  Of triangles much smaller than the spacing, without a boundary.
/// @return         Vertices of the surface: fewer than asked for if it has no more.
[[nodiscard]] std::vector<Eigen::Vector3d> find_places(const TriMesh& surface,
                                                       const CellNetPlaces& wanted);

}  // namespace trivalent::remesh
