#pragma once

#include <vector>

#include "equalize/constrained_mesh.h"
#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

struct RelaxationOptions {
  int rings = 2;  ///< k
  Restriction restriction = Restriction::hard;
};

/// Positions v + t of the global relaxation [Pecanha2013, Eq. 1-4]: the displacements t minimize
/// Σ w_ij |v_i + t_i - v_j - t_j|² over all pairs up to k rings apart, w_ij = 1/S_j, S_j the number
/// of hops, with t in the tangent plane of the original surface (along the curve for vertices on a
/// feature curve, zero at corners).
///
/// Hard: t has only the allowed components; the reduced Laplacian is symmetric positive definite
/// and is solved by conjugate gradients. Least squares: the rows of the Laplacian, each divided by
/// its sum of weights, and the weighted restrictions are solved together.
///
/// @return One position per vertex, not yet on the surface.
[[nodiscard]] std::vector<Eigen::Vector3d> relaxed_positions(const ConstrainedMesh& constrained,
                                                             const RelaxationOptions& options);

}  // namespace trivalent::remesh
