#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "crystal/membrane.h"
#include "crystal/vertex_images.h"

namespace trivalent::remesh {

/// Inverse of the 3 × 3 diagonal blocks of the Hessian of a membrane's energy, for its
/// minimization.
///
/// Springs count as if they were at rest, so that every block is positive definite. Blocks follow
/// the directions of the edges: along the net they are stiff, across it soft, however it is tilted.
template <typename Scalar>
class MembranePreconditioner {
 public:
  /// @param x      Of vertices and images.
  /// @param count  Vertices that move: 0 to count - 1. Those without a term get zero.
  MembranePreconditioner(const Membrane& membrane, const MembraneTerms<Scalar>& terms,
                         const std::vector<Lanes<Scalar>>& x, std::size_t count,
                         const VertexImages& images);

  /// Multiplies a vector, four numbers a vertex.
  template <typename Vector>
  void apply(Vector& v) const {
    for (std::size_t i = 0; i < inverse_.size(); ++i) {
      auto part = v.template segment<4>(4 * static_cast<Eigen::Index>(i));
      const Block& block = inverse_[i];
      part = (part[0] * block.col(0) + part[1] * block.col(1) + part[2] * block.col(2)).eval();
    }
  }

 private:
  using Block = Eigen::Matrix<Scalar, 4, 3>;  // the last row is zero
  std::vector<Block> inverse_;
};

}  // namespace trivalent::remesh
