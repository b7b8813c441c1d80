#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
/// One point per row.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The k-ring operator of [Pecanha2013, Eq. 3] for n vertices.
struct KRingSystem {
  /// L: row i holds Σ_j 1/S_j on the diagonal and -1/S_j at every vertex j that is S_j ≤ k hops
  /// from i. Symmetric, positive semidefinite; n x n.
  SparseMatrix laplacian;
  /// What stands for L v: row i is -Σ_j 1/S_j x_ij, x_ij the offset from i to j unfolded into the
  /// tangent plane at i. On a plane it is L v itself.
  Positions gradient;
  /// How much the surface folds within the k rings: the mean of 1 - n_i · n_j with weights 1/S_j; 0
  /// on a plane, 1 where half of the neighbors face the other way.
  Eigen::VectorXd folding;
};

/// Builds the operator for all neighborhoods of up to `rings` rings.
///
/// The printed Eq. 3 takes the straight offset v_j - v_i. Where the surface folds, the far side of
/// the fold is then foreshortened in the tangent plane, and vertices flee from folds the more the
/// larger k is. Here offsets are unfolded ring by ring (each edge turned from the tangent plane of
/// its start into that at i, its length kept), so that a regular net is at rest on curved surfaces
/// too.
///
/// @param normals  Unit normal of the original surface at every vertex.
[[nodiscard]] KRingSystem k_ring_system(const TriMesh& mesh,
                                        const std::vector<Eigen::Vector3d>& normals, int rings);

}  // namespace trivalent::remesh
