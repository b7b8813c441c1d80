#include "crystal/membrane_laplacian.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <vector>

namespace trivalent::remesh {

namespace {

/// Of k, for vertices that nothing holds; small against the softest mode of a net.
constexpr double relative_anchor = 1e-4;

}  // namespace

MembraneLaplacian::MembraneLaplacian(const Membrane& membrane, const MembraneTerms<double>& terms,
                                     std::size_t count, const VertexImages& images) {
  // The mean over all directions in the net of a spring, which has no stiffness across it.
  const double spring = 0.5 * membrane.stretching;
  using Matrix = Eigen::SparseMatrix<double>;
  std::vector<double> diagonal(count, relative_anchor * membrane.stretching);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(count + terms.hinges.size() + terms.edges.size());
  const auto add_spring = [&](int first, int second) {
    const int a = images.vertex_of(first);
    const int b = images.vertex_of(second);
    if (a == b) return;  // a vertex and its own image move together
    diagonal[static_cast<std::size_t>(a)] += spring;
    diagonal[static_cast<std::size_t>(b)] += spring;
    entries.emplace_back(std::max(a, b), std::min(a, b), -spring);
  };
  for (const Hinge& h : terms.hinges) add_spring(h.a, h.b);
  for (const auto& [a, b] : terms.edges) add_spring(a, b);
  for (const Tether<double>& t : terms.tethers) {
    diagonal[static_cast<std::size_t>(t.i)] += t.stiffness / 3.0;
  }
  const auto n = static_cast<Eigen::Index>(count);
  for (Eigen::Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, diagonal[static_cast<std::size_t>(i)]);
  }
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factorization(matrix);
  factor_ = Matrix(factorization.matrixL()).cast<float>();
  const auto& places = factorization.permutationP().indices();
  place_.assign(places.begin(), places.end());
}

void MembraneLaplacian::apply(Eigen::VectorXd& v) const {
  using Column = Eigen::SparseMatrix<float>::InnerIterator;
  const Eigen::Index n = factor_.rows();
  auto lanes = v.reshaped(4, n);
  std::vector<Lanes<float>> x(place_.size());
  const auto at = [&](Eigen::Index i) -> Lanes<float>& { return x[static_cast<std::size_t>(i)]; };
  for (Eigen::Index i = 0; i < n; ++i)
    at(place_[static_cast<std::size_t>(i)]) = lanes.col(i).cast<float>();
  for (Eigen::Index j = 0; j < n; ++j) {
    Column entry(factor_, j);
    at(j) /= entry.value();
    while (++entry) at(entry.row()) -= entry.value() * at(j);
  }
  for (Eigen::Index j = n; j-- > 0;) {
    Column entry(factor_, j);
    const float diagonal = entry.value();
    while (++entry) at(j) -= entry.value() * at(entry.row());
    at(j) /= diagonal;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    lanes.col(i) = at(place_[static_cast<std::size_t>(i)]).cast<double>();
}

}  // namespace trivalent::remesh
