#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "relax/vectors.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// Preconditioner [Packwood2016]: the stiffness of a network whose bonds are springs of one
/// stiffness, isotropic, and in which pieces that no bond connects hold each other where they
/// touch.
///
/// It removes the slow stretching modes of large pieces from a minimization and leaves the bending
/// modes. Of one piece, it depends on the network only and is factorized once. In single precision:
/// it is an approximation anyway, and its time goes with the memory it takes.
class BondLaplacian {
 public:
  /// @param fixed  atoms that do not move
  BondLaplacian(const Atoms& atoms, std::span<const Bond> bonds,
                std::span<const std::uint32_t> fixed);

  /// Whether it depends on where the atoms are: if there are several pieces.
  [[nodiscard]] bool depends_on_positions() const { return has_pieces_; }

  /// Replaces forces [eV/Å] on all coordinates by the displacements [Å] at which they would vanish.
  void solve(Vector& forces) const;

 private:
  bool has_pieces_;
  Eigen::SparseMatrix<float> factor_;  // lower triangle; diagonals first in its columns
  std::vector<Eigen::Index> place_;    // of each atom in it
};

}  // namespace trivalent::potentials::relax_detail
