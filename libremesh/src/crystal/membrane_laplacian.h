#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "crystal/membrane.h"
#include "crystal/vertex_images.h"

namespace trivalent::remesh {

/// Inverse of the Hessian of a membrane's energy if its springs pulled equally in all directions,
/// for the minimization of a whole net.
///
/// It spreads what one vertex feels over the whole net at once, where MembranePreconditioner needs
/// a step for every edge on the way. In single precision: it is an approximation anyway, and its
/// time goes with the memory it takes.
class MembraneLaplacian {
 public:
  /// @param count  Vertices that move: 0 to count - 1.
  MembraneLaplacian(const Membrane& membrane, const MembraneTerms<double>& terms, std::size_t count,
                    const VertexImages& images);

  /// Multiplies a vector, four numbers a vertex.
  void apply(Eigen::VectorXd& v) const;

 private:
  Eigen::SparseMatrix<float> factor_;  ///< lower triangle; diagonals first in its columns
  std::vector<int> place_;             ///< of each vertex in it
};

}  // namespace trivalent::remesh
