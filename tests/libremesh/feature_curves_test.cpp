#include "equalize/feature_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

constexpr double right_angle = std::numbers::pi / 2.0;

TEST(FeatureCurves, FindsTwelveCreasesAndEightCornersOfACube) {
  const TriMesh mesh = testing_support::cube();
  const FeatureCurves features(mesh, find_creases(mesh, right_angle / 2.0));
  std::set<int> curves;
  for (const auto e : mesh.edges()) {
    if (features.curve_of(e)) curves.insert(*features.curve_of(e));
  }
  EXPECT_EQ(curves.size(), 12u);
  for (const auto v : mesh.vertices()) EXPECT_EQ(features.kind(v), FeatureKind::corner);
}

TEST(FeatureCurves, HasNoCreasesUnlessAskedFor) {
  EXPECT_TRUE(FeatureCurves(testing_support::cube()).empty());
  EXPECT_TRUE(FeatureCurves(testing_support::cube(),
                            find_creases(testing_support::cube(), 1.1 * right_angle))
                  .empty());
}

TEST(FeatureCurves, CutsTheBoundaryOfASheetAtItsCorners) {
  const TriMesh sheet = testing_support::triangular_sheet(5, 3);
  const FeatureCurves features(sheet);
  int corners = 0;
  for (const auto v : sheet.vertices()) {
    EXPECT_EQ(features.kind(v) == FeatureKind::none, !v.is_boundary());
    if (features.kind(v) == FeatureKind::corner) ++corners;
  }
  EXPECT_EQ(corners, 4);
}

TEST(FeatureCurves, KnowsHowFarBoundariesTurn) {
  constexpr double full = 2.0 * std::numbers::pi;
  const FeatureCurves sheet(testing_support::triangular_sheet(5, 3));
  ASSERT_EQ(sheet.boundaries().size(), 1u);
  EXPECT_NEAR(sheet.boundaries().front().turn, full, 1e-12);
  for (int curve = 0; curve < sheet.size(); ++curve) EXPECT_EQ(sheet.boundary_of(curve), 0);
  const FeatureCurves tube(make_shape("open-tube", {}, 0.2));
  ASSERT_EQ(tube.boundaries().size(), 2u);
  for (const auto& end : tube.boundaries()) EXPECT_NEAR(end.turn, 0.0, 1e-9);
  TriMesh with_hole = testing_support::triangular_sheet(8, 8);
  with_hole.delete_vertex(VertexHandle(40), false);
  with_hole.garbage_collection();
  const FeatureCurves hole(with_hole);
  ASSERT_EQ(hole.boundaries().size(), 2u);
  EXPECT_NEAR(hole.boundaries()[0].turn + hole.boundaries()[1].turn, 0.0, 1e-9);
  const FeatureCurves cube(testing_support::cube(),
                           find_creases(testing_support::cube(), right_angle / 2.0));
  EXPECT_TRUE(cube.boundaries().empty());
  EXPECT_FALSE(cube.boundary_of(0).has_value());
}

TEST(FeatureCurves, SlidesAlongTheCurveAndNotBeyondItsEnds) {
  const TriMesh sheet = testing_support::triangular_sheet(6, 2);
  const FeatureCurves features(sheet);
  const auto on_lower_side =
      std::find_if(sheet.vertices_begin(), sheet.vertices_end(), [&](const auto& v) {
        return features.kind(v) == FeatureKind::curve && sheet.point(v).y() == 0.0;
      });
  const CurvePoint start = features.at(*on_lower_side);
  const CurvePoint moved = features.nearest({3.7, 0.4, 0.2}, start);
  EXPECT_LT((moved.position - Eigen::Vector3d(3.7, 0.0, 0.0)).norm(), 1e-14);
  EXPECT_EQ(moved.curve, start.curve);
  EXPECT_NEAR(std::abs(features.tangent(moved).x()), 1.0, 1e-15);
  const Eigen::Vector3d beyond(50.0, -20.0, 0.0);
  const CurvePoint end = features.nearest(beyond, start);
  EXPECT_EQ(end.position, features.nearest(beyond, start.curve).position);
}

}  // namespace
}  // namespace trivalent::remesh
