#include "equalize/feature_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "mesh_fixtures.h"

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
