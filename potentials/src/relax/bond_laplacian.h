#pragma once

#include <Eigen/SparseCholesky>
#include <span>

#include "relax/vectors.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// How stiff a network of bonds is, seen from afar: springs of one stiffness along all bonds, alike
/// in all directions.
///
/// As a preconditioner [Packwood2016] it takes the stretching of large pieces out of a minimizer's
/// way; what is left are bending modes. It depends on the network only and is factorized once.
class BondLaplacian {
 public:
  /// @param n_atoms  number of atoms
  /// @param fixed    atoms that do not move
  BondLaplacian(std::size_t n_atoms, std::span<const Bond> bonds,
                std::span<const std::uint32_t> fixed);

  /// Replaces forces [eV/Å] on all coordinates by the way [Å] to where they would vanish.
  void solve(Vector& forces) const;

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
};

}  // namespace trivalent::potentials::relax_detail
