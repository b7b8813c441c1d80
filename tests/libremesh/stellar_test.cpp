#include "equalize/stellar.h"

#include <gtest/gtest.h>

#include "equalize/face_guard.h"
#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

StellarLimits limits_around(double target) {
  return {.target = target,
          .shortest = 0.8 * target,
          .longest = 1.2 * target,
          .overlong = 1.5 * target};
}

TEST(ApplyStellarOperations, LeavesEdgesWithinTheLimitsAlone) {
  TriMesh sheet = testing_support::triangular_sheet(5, 5);
  ConstrainedMesh constrained(sheet);
  EXPECT_EQ(apply_stellar_operations(constrained, limits_around(1.0)), 0);
}

TEST(ApplyStellarOperations, SplitsLongEdgesAtTheirMidpoints) {
  TriMesh sheet = testing_support::triangular_sheet(5, 5);
  const double area = surface_area(sheet);
  ConstrainedMesh constrained(sheet);
  const int changed = apply_stellar_operations(constrained, limits_around(0.5));
  EXPECT_GT(changed, 5);
  EXPECT_EQ(sheet.n_vertices(), 36u + static_cast<unsigned>(changed));
  EXPECT_NEAR(surface_area(sheet), area, 1e-12);
  EXPECT_EQ(euler_characteristic(sheet), 1);
}

TEST(ApplyStellarOperations, CollapsesShortEdgesAndKeepsTheOutline) {
  TriMesh sheet = testing_support::triangular_sheet(12, 12);
  const double area = surface_area(sheet);
  ConstrainedMesh constrained(sheet);
  const int changed = apply_stellar_operations(constrained, limits_around(2.0));
  EXPECT_GT(changed, 5);
  EXPECT_EQ(sheet.n_vertices(), 169u - static_cast<unsigned>(changed));
  EXPECT_NEAR(surface_area(sheet), area, 1e-12);
  EXPECT_EQ(euler_characteristic(sheet), 1);
}

TEST(ApplyStellarOperations, CannotCollapseATetrahedron) {
  TriMesh tetrahedron = testing_support::tetrahedron();
  ConstrainedMesh constrained(tetrahedron);
  EXPECT_EQ(apply_stellar_operations(constrained, limits_around(100.0)), 0);
}

TEST(ApplyStellarOperations, KeepsTheGenusHoweverCoarse) {
  TriMesh mesh = make_shape("double-torus", {}, 0.15);
  ConstrainedMesh constrained(mesh);
  for (int round = 0; round < 30; ++round)
    apply_stellar_operations(constrained, limits_around(10.0));
  EXPECT_EQ(euler_characteristic(mesh), -2);
  EXPECT_TRUE(testing_support::is_closed(mesh));
  for (const auto v : mesh.vertices()) EXPECT_GE(v.valence(), 3u);
}

TEST(ApplyStellarOperations, MendsValencesWithinTheLimitsOnlyIfAskedTo) {
  // A split edge in a regular sheet leaves a vertex of valence 4 and two of 7; a collapse undoes
  // it.
  TriMesh sheet = testing_support::triangular_sheet(8, 8);
  const VertexHandle center(4 * 9 + 4);
  const HalfedgeHandle h = sheet.halfedge_handle(center);
  const Eigen::Vector3d midpoint = sheet.point(center) + 0.5 * sheet.calc_edge_vector(h);
  sheet.split(sheet.edge_handle(h), midpoint);
  ConstrainedMesh constrained(sheet);
  StellarLimits wide{.target = 2.0, .shortest = 0.1, .longest = 10.0, .overlong = 10.0};
  EXPECT_EQ(apply_stellar_operations(constrained, wide), 0);
  wide.mends_valences = true;
  EXPECT_GT(apply_stellar_operations(constrained, wide), 0);
}

TEST(FacesStayUpright, SeesAFaceTurnOver) {
  const TriMesh sheet = testing_support::triangular_sheet(4, 4);
  VertexHandle inside;
  for (const auto v : sheet.vertices()) {
    if (!v.is_boundary()) inside = v;
  }
  EXPECT_TRUE(
      faces_stay_upright(sheet, inside, sheet.point(inside) + Eigen::Vector3d(0.2, 0.1, 0.0)));
  EXPECT_FALSE(
      faces_stay_upright(sheet, inside, sheet.point(inside) + Eigen::Vector3d(2.0, 0.1, 0.0)));
}

}  // namespace
}  // namespace trivalent::remesh
