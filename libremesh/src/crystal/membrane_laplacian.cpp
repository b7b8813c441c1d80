#include "crystal/membrane_laplacian.h"

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
  factor_.compute(matrix);
}

void MembraneLaplacian::apply(Eigen::VectorXd& v) const {
  const Eigen::Index n = factor_.rows();
  auto lanes = v.reshaped(4, n);
  const Eigen::Matrix<double, Eigen::Dynamic, 3> solved =
      factor_.solve(Eigen::Matrix<double, Eigen::Dynamic, 3>(lanes.topRows<3>().transpose()));
  lanes.topRows<3>() = solved.transpose();
}

}  // namespace trivalent::remesh
