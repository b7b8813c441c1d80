#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "equalize/k_ring_laplacian.h"

namespace trivalent::remesh {

class TangentLaplacian;

/// Two orthonormal directions in which a vertex may move; a zero column where it may not.
using TangentBasis = Eigen::Matrix<double, 3, 2>;

}  // namespace trivalent::remesh

namespace Eigen::internal {
template <>
struct traits<trivalent::remesh::TangentLaplacian>
    : public traits<Eigen::SparseMatrix<double, Eigen::RowMajor, int>> {};
}  // namespace Eigen::internal

namespace trivalent::remesh {

/// The operator Bᵀ L B of 2n tangent components, applied without being formed: that takes a quarter
/// of the memory of its entries. Symmetric, positive semidefinite.
class TangentLaplacian : public Eigen::EigenBase<TangentLaplacian> {
 public:
  // What Eigen's solvers ask of a matrix.
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = true
  };

  TangentLaplacian(const SparseMatrix& laplacian, const std::vector<TangentBasis>& bases)
      : laplacian_(laplacian), bases_(bases), moved_(laplacian.rows(), 3) {}

  [[nodiscard]] Eigen::Index rows() const { return 2 * laplacian_.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  [[nodiscard]] const SparseMatrix& laplacian() const { return laplacian_; }

  template <typename Right>
  [[nodiscard]] Eigen::Product<TangentLaplacian, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right>& x) const {
    return {*this, x.derived()};
  }

  /// B u: displacements from tangent components.
  [[nodiscard]] Positions from_tangent(const Eigen::VectorXd& components) const {
    Positions displacements(laplacian_.rows(), 3);
    expand(components, displacements);
    return displacements;
  }

  /// Bᵀ x: tangent components of vectors.
  [[nodiscard]] Eigen::VectorXd to_tangent(const Positions& vectors) const {
    Eigen::VectorXd components(rows());
    for (Eigen::Index i = 0; i < laplacian_.rows(); ++i) {
      components.segment<2>(2 * i) = basis(i).transpose() * vectors.row(i).transpose();
    }
    return components;
  }

  /// y += factor · Bᵀ L B u
  template <typename Result, typename Components>
  void add_product(Result& y, const Components& u, double factor) const {
    expand(u, moved_);
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, laplacian_.rows(), 1024),
                      [&](const auto& range) {
                        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
                          Eigen::Vector3d row = Eigen::Vector3d::Zero();
                          for (SparseMatrix::InnerIterator entry(laplacian_, i); entry; ++entry) {
                            row += entry.value() * moved_.row(entry.col()).transpose();
                          }
                          y.template segment<2>(2 * i) += factor * (basis(i).transpose() * row);
                        }
                      });
  }

 private:
  [[nodiscard]] const TangentBasis& basis(Eigen::Index i) const {
    return bases_[static_cast<std::size_t>(i)];
  }

  template <typename Components>
  void expand(const Components& components, Positions& displacements) const {
    for (Eigen::Index i = 0; i < laplacian_.rows(); ++i) {
      displacements.row(i) = (basis(i) * components.template segment<2>(2 * i)).transpose();
    }
  }

  const SparseMatrix& laplacian_;
  const std::vector<TangentBasis>& bases_;
  mutable Positions moved_;  // scratch of add_product
};

/// Jacobi preconditioner: the diagonal of Bᵀ L B is that of L, twice.
class TangentJacobi {
 public:
  TangentJacobi() = default;
  explicit TangentJacobi(const TangentLaplacian& matrix) { compute(matrix); }
  TangentJacobi& analyzePattern(const TangentLaplacian&) { return *this; }
  TangentJacobi& factorize(const TangentLaplacian& matrix) { return compute(matrix); }
  TangentJacobi& compute(const TangentLaplacian& matrix) {
    inverse_.resize(matrix.rows());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      inverse_[i] = 1.0 / matrix.laplacian().coeff(i / 2, i / 2);
    }
    return *this;
  }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    return inverse_.cwiseProduct(right);
  }
  static Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  Eigen::VectorXd inverse_;
};

}  // namespace trivalent::remesh

namespace Eigen::internal {
template <typename Right>
struct generic_product_impl<trivalent::remesh::TangentLaplacian, Right, SparseShape, DenseShape,
                            GemvProduct>
    : generic_product_impl_base<trivalent::remesh::TangentLaplacian, Right,
                                generic_product_impl<trivalent::remesh::TangentLaplacian, Right>> {
  template <typename Result>
  static void scaleAndAddTo(Result& result, const trivalent::remesh::TangentLaplacian& matrix,
                            const Right& right, const double& factor) {
    matrix.add_product(result, right, factor);
  }
};
}  // namespace Eigen::internal
