#include "crystal/tether_strength.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "trivalent/remesh/mesh.h"
#include "trivalent/remesh/periodic.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/remesh/surface_shape.h"

namespace trivalent::remesh {
namespace {

TriMesh scaled(TriMesh mesh, double factor) {
  scale(mesh, factor);
  return mesh;
}

double factor_of(const TriMesh& surface) { return tether_factor(surface, surface_area(surface)); }

TriMesh sphere(double radius) { return scaled(make_shape("sphere", {}, 0.1), radius); }

/// Two copies of a mesh, apart.
TriMesh two_of(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> points(mesh.points(), mesh.points() + mesh.n_vertices());
  std::vector<std::array<int, 3>> triangles = triangles_of(mesh);
  const auto n = static_cast<int>(points.size());
  const double apart = 2.0 * bounding_box(mesh).diagonal();
  for (int i = 0; i < n; ++i) {
    points.emplace_back(points[std::size_t(i)] + apart * Eigen::Vector3d::UnitX());
  }
  const std::size_t one = triangles.size();
  for (std::size_t f = 0; f < one; ++f) {
    triangles.push_back({triangles[f][0] + n, triangles[f][1] + n, triangles[f][2] + n});
  }
  return make_mesh(points, triangles);
}

TEST(TetherFactor, OfLargeSpheresGoesWithTheFourthPowerOfTheRadius) {
  EXPECT_NEAR(factor_of(sphere(100.0)), std::pow(40.0 / 100.0, 4.0), 0.02 * std::pow(0.4, 4.0));
  EXPECT_NEAR(factor_of(sphere(200.0)) / factor_of(sphere(100.0)), 1.0 / 16.0, 1e-6);
}

TEST(TetherFactor, OfSmallSpheresIsMoreThanOne) {
  EXPECT_GT(factor_of(sphere(10.0)), 30.0);
  EXPECT_EQ(factor_of(sphere(30.0)), 1.0);
}

TEST(TetherFactor, IsTheSameOfTwoShapesAsOfOne) {
  for (const double radius : {10.0, 17.0, 30.0, 100.0}) {
    EXPECT_NEAR(factor_of(two_of(sphere(radius))), factor_of(sphere(radius)), 1e-9) << radius;
  }
}

TEST(TetherFactor, IsTheSameOfMoreCellsOfALargeCrystal) {
  const TriMesh cell = scaled(make_shape("schwarz-p", {}, 0.05), 300.0);
  EXPECT_NEAR(factor_of(repeated(cell, {3, 3, 3})), factor_of(cell), 1e-9);
  const TriMesh middling = scaled(make_shape("schwarz-p", {}, 0.05), 60.0);
  EXPECT_EQ(factor_of(repeated(middling, {4, 4, 4})), 1.0);
}

TEST(TetherFactor, OfALargeRoughShapeIsSmallAndOfThinArmsIsNot) {
  // Tori of one area, that of 120,000 atoms: tubes with radii of 20 and of 5 Å.
  const TriMesh wide = scaled(make_shape("torus", {{"R", 20.0}, {"r", 1.0}}, 0.3), 20.0);
  const TriMesh thin = scaled(make_shape("torus", {{"R", 320.0}, {"r", 1.0}}, 0.5), 5.0);
  EXPECT_LT(factor_of(wide), 0.4);
  EXPECT_EQ(factor_of(thin), 1.0);
}

TEST(TetherFactor, OfAnOpenSheetIsNeverLessThanOne) {
  EXPECT_GE(factor_of(scaled(make_shape("wavy-sheet", {}, 0.2), 500.0)), 1.0);
}

}  // namespace
}  // namespace trivalent::remesh
