#include "equalize/relaxation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>

#include "equalize/k_ring_laplacian.h"
#include "equalize/tangent_laplacian.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Relative residual at which the solvers stop. What is left are long waves that the next iteration
/// of the remeshing goes on with; a sharper solution leaves the results as they are.
constexpr double solver_tolerance = 1e-2;
/// Part of its weights that a vertex is held back by: adds damping · Σ_j w_ij |t_i|² to the energy.
/// The bare energy is that of a harmonic map, which empties limbs (a bunny's ears) over the
/// iterations and has no unique minimum on a plane or cylinder; damped, waves longer than some ten
/// edges stay, the system is positive definite, and the solver's steps do not grow with the mesh.
constexpr double damping = 0.05;
/// Stiffness of an edge as a spring, per unit of folding, against a weight w_ij of 1.
constexpr double spring_stiffness = 10.0;
/// Weight of a restriction row against a Laplacian row of weight 1.
constexpr double restriction_weight = 10.0;

/// Directions in which a vertex may move (the first `allowed` columns) and may not (the others).
struct Frame {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  int allowed = 0;
};

Eigen::Matrix3d axes_with_last(const Eigen::Vector3d& last) {
  Eigen::Matrix3d axes;
  axes.col(0) = last.unitOrthogonal();
  axes.col(1) = last.cross(axes.col(0));
  axes.col(2) = last;
  return axes;
}

Frame frame_at(const ConstrainedMesh& constrained, VertexHandle v) {
  const Anchor& anchor = constrained.anchor(v);
  switch (anchor.kind) {
    case FeatureKind::none:
      return {axes_with_last(constrained.normal(v)), 2};
    case FeatureKind::curve: {
      const Eigen::Matrix3d axes = axes_with_last(constrained.curves().tangent(anchor.on_curve));
      return {axes.rowwise().reverse(), 1};
    }
    case FeatureKind::corner:
      break;
  }
  return {Eigen::Matrix3d::Identity(), 0};
}

template <typename Function>
void for_each_vertex(std::size_t count, const Function& function) {
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, static_cast<Eigen::Index>(count)),
                    [&](const auto& range) {
                      for (Eigen::Index i = range.begin(); i < range.end(); ++i) function(i);
                    });
}

/// t = B u with (Bᵀ L B) u = -Bᵀ (L v).
Positions hard_displacements(const ConstrainedMesh& constrained, const KRingSystem& system) {
  std::vector<TangentBasis> bases(constrained.mesh.n_vertices());
  for_each_vertex(bases.size(), [&](Eigen::Index i) {
    const Frame frame = frame_at(constrained, VertexHandle(static_cast<int>(i)));
    TangentBasis& basis = bases[static_cast<std::size_t>(i)];
    basis = frame.axes.leftCols<2>();
    if (frame.allowed < 2) basis.col(1).setZero();
    if (frame.allowed < 1) basis.col(0).setZero();
  });
  const TangentLaplacian tangent_laplacian(system.laplacian, bases);
  Eigen::ConjugateGradient<TangentLaplacian, Eigen::Lower | Eigen::Upper, TangentJacobi> solver;
  solver.setTolerance(solver_tolerance);
  solver.compute(tangent_laplacian);
  const Eigen::VectorXd components = solver.solve(-tangent_laplacian.to_tangent(system.gradient));
  return tangent_laplacian.from_tangent(components);
}

/// The system of [Pecanha2013, Eq. 4]: rows of the Laplacian, each divided by its sum of weights,
/// then the weighted restrictions; three unknowns per vertex. A vertex bound to a curve or corner
/// has Laplacian rows only in its allowed directions: in the others its neighbors all lie on one
/// side, and a pull that the restriction balances would drag the whole net along.
struct LeastSquaresSystem {
  SparseMatrix rows;
  Eigen::VectorXd right;
};

LeastSquaresSystem least_squares_system(const ConstrainedMesh& constrained,
                                        const KRingSystem& system) {
  const SparseMatrix& laplacian = system.laplacian;
  const Eigen::Index n = laplacian.rows();
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(3 * laplacian.nonZeros() + 3 * n));
  Eigen::VectorXd right = Eigen::VectorXd::Zero(6 * n);
  int row = 0;
  const auto add_laplacian_row = [&](int i, const Eigen::Vector3d& direction) {
    const double weight = laplacian.coeff(i, i);
    for (SparseMatrix::InnerIterator entry(laplacian, i); entry; ++entry) {
      for (int c = 0; c < 3; ++c) {
        if (direction[c] == 0.0) continue;
        entries.emplace_back(row, 3 * static_cast<int>(entry.col()) + c,
                             direction[c] * entry.value() / weight);
      }
    }
    right[row++] = -system.gradient.row(i).dot(direction) / weight;
  };
  for (int i = 0; i < static_cast<int>(n); ++i) {
    const Frame frame = frame_at(constrained, VertexHandle(i));
    const bool is_free = constrained.anchor(VertexHandle(i)).kind == FeatureKind::none;
    const Eigen::Matrix3d directions = is_free ? Eigen::Matrix3d::Identity() : frame.axes;
    for (int d = 0; d < (is_free ? 3 : frame.allowed); ++d) add_laplacian_row(i, directions.col(d));
    for (int forbidden = frame.allowed; forbidden < 3; ++forbidden, ++row) {
      for (int c = 0; c < 3; ++c) {
        entries.emplace_back(row, 3 * i + c, restriction_weight * frame.axes(c, forbidden));
      }
    }
  }
  SparseMatrix rows(row, 3 * n);
  rows.setFromTriplets(entries.begin(), entries.end());
  return {rows, right.head(row)};
}

Positions least_squares_displacements(const ConstrainedMesh& constrained,
                                      const KRingSystem& system) {
  const auto [rows, right] = least_squares_system(constrained, system);
  Eigen::LeastSquaresConjugateGradient<SparseMatrix> solver;
  solver.setTolerance(solver_tolerance);
  solver.compute(rows);
  const Eigen::VectorXd displacements = solver.solve(right);
  return Eigen::Map<const Positions>(displacements.data(), system.gradient.rows(), 3);
}

/// Where the surface folds within the rings, edges pull and push as springs of the mean length, one
/// step of Newton's method with the other end held: at a fingertip or an ear centroids say little
/// of where to go, and the bare relaxation drains it over the iterations. On flat parts nothing
/// changes.
void add_springs_at_folds(const TriMesh& mesh, KRingSystem& system) {
  const double mean_length = mean_edge_length(mesh);
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(system.laplacian.rows());
  for (const auto e : mesh.edges()) {
    const int i = e.v0().idx();
    const int j = e.v1().idx();
    const Eigen::Vector3d edge = vector_between(mesh, e.v0(), e.v1());
    const double length = edge.norm();
    if (length == 0.0) continue;
    const double folding = std::min(1.0, 0.5 * (system.folding[i] + system.folding[j]));
    const double spring = spring_stiffness * folding;
    const Eigen::Vector3d pull = spring * (1.0 - mean_length / length) * edge;
    system.gradient.row(i) -= pull.transpose();
    system.gradient.row(j) += pull.transpose();
    stiffness[i] += spring;
    stiffness[j] += spring;
  }
  system.laplacian.diagonal() += stiffness;
}

}  // namespace

std::vector<Eigen::Vector3d> relaxed_positions(const ConstrainedMesh& constrained,
                                               const RelaxationOptions& options) {
  const TriMesh& mesh = constrained.mesh;
  std::vector<Eigen::Vector3d> normals(mesh.n_vertices());
  for_each_vertex(normals.size(), [&](Eigen::Index i) {
    normals[static_cast<std::size_t>(i)] = constrained.normal(VertexHandle(static_cast<int>(i)));
  });
  KRingSystem system = k_ring_system(mesh, normals, options.rings);
  system.laplacian.diagonal() *= 1.0 + damping;
  add_springs_at_folds(mesh, system);
  const Positions displacements = options.restriction == Restriction::hard
                                      ? hard_displacements(constrained, system)
                                      : least_squares_displacements(constrained, system);
  std::vector<Eigen::Vector3d> relaxed(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    relaxed[static_cast<std::size_t>(v.idx())] =
        mesh.point(v) + displacements.row(v.idx()).transpose();
  }
  return relaxed;
}

}  // namespace trivalent::remesh
