#include "equalize/relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "equalize/k_ring_laplacian.h"
#include "equalize/sliding.h"
#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

std::vector<Eigen::Vector3d> normals_of(const ConstrainedMesh& constrained) {
  std::vector<Eigen::Vector3d> normals;
  for (const auto v : constrained.mesh.vertices()) normals.push_back(constrained.normal(v));
  return normals;
}

TEST(KRingSystem, WeighsVerticesByTheirHops) {
  TriMesh sheet = testing_support::triangular_sheet(8, 8);
  const ConstrainedMesh constrained(sheet);
  const auto laplacian = k_ring_system(sheet, normals_of(constrained), 3).laplacian;
  const int center = 4 * 9 + 4;  // the middle of the 9 x 9 vertices
  EXPECT_EQ(laplacian.coeff(center, center + 1), -1.0);
  EXPECT_EQ(laplacian.coeff(center, center + 2), -1.0 / 2.0);
  EXPECT_EQ(laplacian.coeff(center, center + 3), -1.0 / 3.0);
  EXPECT_EQ(laplacian.coeff(center, center + 4), 0.0);
  EXPECT_NEAR(laplacian.coeff(center, center), 6 * 1.0 + 12 * (1.0 / 2.0) + 18 * (1.0 / 3.0),
              1e-14);
}

TEST(KRingSystem, IsSymmetricAndHasZeroRowSums) {
  TriMesh torus = make_shape("torus", {}, 0.3);
  const ConstrainedMesh constrained(torus);
  const SparseMatrix laplacian = k_ring_system(torus, normals_of(constrained), 2).laplacian;
  const SparseMatrix transposed = laplacian.transpose();
  EXPECT_EQ((laplacian - transposed).norm(), 0.0);
  EXPECT_LT((laplacian * Eigen::VectorXd::Ones(laplacian.cols())).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(KRingSystem, OnAPlaneTheGradientIsLv) {
  TriMesh sheet = testing_support::triangular_sheet(6, 5);
  const ConstrainedMesh constrained(sheet);
  const KRingSystem system = k_ring_system(sheet, normals_of(constrained), 3);
  Positions positions(static_cast<Eigen::Index>(sheet.n_vertices()), 3);
  for (const auto v : sheet.vertices()) positions.row(v.idx()) = sheet.point(v).transpose();
  EXPECT_LT((system.gradient - system.laplacian * positions).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(KRingSystem, ARegularNetOnACylinderIsAtRest) {
  TriMesh tube = make_shape("open-tube", {}, 0.25);
  ConstrainedMesh constrained(tube);
  // The exact cylinder's normals: with them, unfolding is exact up to the chords' sag.
  std::vector<Eigen::Vector3d> normals;
  for (const auto v : tube.vertices()) {
    normals.push_back(Eigen::Vector3d(tube.point(v).x(), tube.point(v).y(), 0.0).normalized());
  }
  const int rings = 3;
  const KRingSystem system = k_ring_system(tube, normals, rings);
  const BoundingBox box = bounding_box(tube);
  for (const auto v : tube.vertices()) {
    const double to_end =
        std::min(tube.point(v).z() - box.low.z(), box.high.z() - tube.point(v).z());
    if (to_end < (rings + 1) * 0.25) continue;
    ASSERT_LT(system.gradient.row(v.idx()).norm(), 1e-10) << "vertex " << v.idx();
  }
}

TEST(KRingSystem, FoldsNowhereOnAPlaneAndMoreOnASmallerSphere) {
  TriMesh sheet = testing_support::triangular_sheet(5, 5);
  const ConstrainedMesh on_sheet(sheet);
  EXPECT_LT(k_ring_system(sheet, normals_of(on_sheet), 2).folding.maxCoeff(), 1e-15);
  const auto mean_folding = [](double edge) {
    TriMesh sphere = make_shape("sphere", {}, edge);
    const ConstrainedMesh on_sphere(sphere);
    return k_ring_system(sphere, normals_of(on_sphere), 1).folding.mean();
  };
  // 1 - cos of the angle that an edge spans: the square of the edge length over 2.
  EXPECT_NEAR(mean_folding(0.2), 0.02, 0.003);
  EXPECT_NEAR(mean_folding(0.4) / mean_folding(0.2), 4.0, 0.4);
}

class Relaxation : public testing::TestWithParam<Restriction> {};

TEST_P(Relaxation, KeepsAPlaneFlatAndItsOutline) {
  TriMesh sheet = testing_support::triangular_sheet(8, 8);
  ConstrainedMesh constrained(sheet);
  for (const auto v : sheet.vertices()) {  // shake the inside
    if (!v.is_boundary())
      sheet.point(v) += Eigen::Vector3d(0.2 * std::sin(v.idx()), 0.2 * std::cos(3 * v.idx()), 0.0);
  }
  const double area = surface_area(sheet);
  slide_vertices(constrained, relaxed_positions(constrained, {2, GetParam()}));
  EXPECT_NEAR(surface_area(sheet), area, 1e-12);
  for (const auto v : sheet.vertices()) EXPECT_EQ(sheet.point(v).z(), 0.0);
}

TEST_P(Relaxation, BringsAShakenNetBackToRegular) {
  TriMesh sheet = testing_support::triangular_sheet(10, 10);
  ConstrainedMesh constrained(sheet);
  std::vector<Eigen::Vector3d> regular;
  double shaken = 0.0;
  for (const auto v : sheet.vertices()) {
    regular.push_back(sheet.point(v));
    if (v.is_boundary()) continue;
    const Eigen::Vector3d shake(0.2 * std::sin(v.idx()), 0.2 * std::cos(3 * v.idx()), 0.0);
    sheet.point(v) += shake;
    shaken += shake.squaredNorm();
  }
  slide_vertices(constrained, relaxed_positions(constrained, {1, GetParam()}));
  double left = 0.0;
  for (const auto v : sheet.vertices()) {
    left += (sheet.point(v) - regular[static_cast<std::size_t>(v.idx())]).squaredNorm();
  }
  EXPECT_LT(left, 0.1 * shaken);
}

TEST_P(Relaxation, DisplacesWithinTheTangentPlanes) {
  TriMesh torus = make_shape("torus", {}, 0.2);
  const ConstrainedMesh constrained(torus);
  const auto relaxed = relaxed_positions(constrained, {2, GetParam()});
  double along = 0.0;
  double across = 0.0;
  for (const auto v : torus.vertices()) {
    const Eigen::Vector3d t = relaxed[static_cast<std::size_t>(v.idx())] - torus.point(v);
    const double normal_part = t.dot(constrained.normal(v));
    across += normal_part * normal_part;
    along += t.squaredNorm() - normal_part * normal_part;
  }
  // Exactly for the hard restriction; a weight of 10 leaves one part in a hundred of the pull
  // across.
  EXPECT_LT(std::sqrt(across),
            (GetParam() == Restriction::hard ? 1e-13 : 0.1) * std::sqrt(along) + 1e-13);
}

INSTANTIATE_TEST_SUITE_P(BothWays, Relaxation,
                         testing::Values(Restriction::hard, Restriction::least_squares),
                         [](const auto& parameter) {
                           return parameter.param == Restriction::hard ? "hard" : "least_squares";
                         });

TEST(SlideVertices, TurnsNoFaceOver) {
  TriMesh sheet = testing_support::triangular_sheet(8, 8);
  ConstrainedMesh constrained(sheet);
  const auto faces = triangles_of(sheet);
  std::vector<Eigen::Vector3d> wild;
  for (const auto v : sheet.vertices()) {
    wild.push_back(sheet.point(v) +
                   Eigen::Vector3d(3.0 * std::sin(v.idx()), 3.0 * std::cos(5 * v.idx()), 1.0));
  }
  slide_vertices(constrained, wild);
  for (const auto f : sheet.faces()) {
    EXPECT_GE(sheet.calc_normal(f).z(), 0.0);
  }
}

}  // namespace
}  // namespace trivalent::remesh
