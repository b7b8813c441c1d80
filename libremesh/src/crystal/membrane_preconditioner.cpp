#include "crystal/membrane_preconditioner.h"

#include <Eigen/LU>

namespace trivalent::remesh {

template <typename Scalar>
MembranePreconditioner<Scalar>::MembranePreconditioner(const Membrane& membrane,
                                                       const MembraneTerms<Scalar>& terms,
                                                       const std::vector<Lanes<Scalar>>& x,
                                                       std::size_t count,
                                                       const VertexImages& images)
    : inverse_(count, Block::Zero()) {
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  std::vector<Matrix> sum(count, Matrix::Zero());
  const auto add = [&](int number, const Matrix& block) {
    const auto i = static_cast<std::size_t>(images.vertex_of(number));
    if (i < count) sum[i] += block;
  };
  const auto k = static_cast<Scalar>(membrane.stretching);
  const auto add_spring = [&](int a, int b) {
    const Lanes<Scalar> edge = x[static_cast<std::size_t>(b)] - x[static_cast<std::size_t>(a)];
    const auto direction = edge.template head<3>();
    const Matrix block =
        (k / (edge.squaredNorm() + Scalar(1e-12))) * direction * direction.transpose();
    add(a, block);
    add(b, block);
  };
  const Matrix bending = Matrix::Identity() * static_cast<Scalar>(membrane.hinge_stiffness());
  for (const Hinge& h : terms.hinges) {
    add_spring(h.a, h.b);
    for (const int i : {h.a, h.b, h.c, h.d}) add(i, bending);
  }
  for (const auto& [a, b] : terms.edges) add_spring(a, b);
  for (const Tether<Scalar>& t : terms.tethers) {
    const auto normal = t.normal.template head<3>();
    add(t.i, t.stiffness * normal * normal.transpose());
  }
  for (std::size_t i = 0; i < count; ++i) {
    // A vertex with springs alone may lie in their plane.
    const Scalar trace = sum[i].trace();
    if (!(trace > Scalar(0))) continue;
    sum[i] += Matrix::Identity() * (Scalar(1e-4) * trace);
    inverse_[i].template topRows<3>() = sum[i].inverse();
  }
}

template class MembranePreconditioner<float>;
template class MembranePreconditioner<double>;

}  // namespace trivalent::remesh
