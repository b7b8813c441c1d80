#pragma once

#include <Eigen/SparseCholesky>
#include <cstddef>

#include "crystal/membrane.h"
#include "crystal/vertex_images.h"

namespace trivalent::remesh {

/// Inverse of the Hessian of a membrane's energy if its springs pulled equally in all directions,
/// for the minimization of a whole net.
///
/// It spreads what one vertex feels over the whole net at once, where MembranePreconditioner needs
/// a step for every edge on the way.
class MembraneLaplacian {
 public:
  /// @param count  Vertices that move: 0 to count - 1.
  MembraneLaplacian(const Membrane& membrane, const MembraneTerms<double>& terms, std::size_t count,
                    const VertexImages& images);

  /// Multiplies a vector, four numbers a vertex.
  void apply(Eigen::VectorXd& v) const;

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
};

}  // namespace trivalent::remesh
