#include "trivalent/remesh/surface_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

using testing_support::octahedron;
using testing_support::triangular_sheet;

TEST(FindFeatureLines, FindsEdgesSharperThanAnAngle) {
  // Normals of neighboring faces of an octahedron have the cosine 1/3.
  const double bend = std::acos(1.0 / 3.0);
  const FeatureLines sharp = find_feature_lines(octahedron(), bend - 1e-9);
  EXPECT_EQ(sharp.edges, 12);
  EXPECT_NEAR(sharp.length, 12.0 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(find_feature_lines(octahedron(), bend + 1e-9).edges, 0);
  EXPECT_EQ(find_feature_lines(triangular_sheet(3, 3), 0.1).edges, 0);
}

TEST(BendingIntegral, IsTheSameForSpheresOfAnySize) {
  for (const double radius : {1.0, 7.0}) {
    const TriMesh sphere = make_shape("sphere", {{"radius", radius}}, 0.05 * radius);
    // Edges of 1/20 of the radius see curvatures to about 1 %; areas differ where valences do.
    const double expected = 16.0 * std::numbers::pi;
    EXPECT_NEAR(bending_integral(sphere), expected, 0.03 * expected);
  }
}

TEST(BendingIntegral, IsNothingOnAPlane) {
  EXPECT_NEAR(bending_integral(triangular_sheet(5, 5)), 0.0, 1e-12);
}

TEST(TightlyCurvedFraction, TellsSpheresBySize) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  // A third of the faces around a vertex of valence 5 is up to a fifth less than its share.
  EXPECT_EQ(tightly_curved_fraction(sphere, 0.8), 0.0);
  EXPECT_EQ(tightly_curved_fraction(sphere, 1.2), 1.0);
}

TEST(TightlyCurvedFraction, TakesHalfTheCurvatureOfACylinder) {
  // Mean curvature 1/2 along the wall of a tube of radius 1; nothing is known at its ends.
  const TriMesh tube = make_shape("open-tube", {{"radius", 1.0}, {"length", 10.0}}, 0.1);
  EXPECT_EQ(tightly_curved_fraction(tube, 1.5), 0.0);
  EXPECT_GT(tightly_curved_fraction(tube, 2.5), 0.95);
}

TEST(TightlyCurvedFraction, IsNothingOnAPlane) {
  EXPECT_EQ(tightly_curved_fraction(triangular_sheet(3, 3), 1e9), 0.0);
}

TEST(TightlyCurvedFraction, LooksAtBothSidesAlike) {
  TriMesh hollow = octahedron();
  for (const auto v : hollow.vertices()) hollow.point(v).x() *= -1.0;
  EXPECT_EQ(tightly_curved_fraction(hollow, 10.0), 1.0);
}

TEST(FindFineParts, TellsHowMuchLargerASphereMustBe) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  const int vertices = static_cast<int>(sphere.n_vertices());
  EXPECT_EQ(find_fine_parts(sphere, 0.8).vertices, 0);
  EXPECT_EQ(find_fine_parts(sphere, 0.8).growth, 1.0);
  EXPECT_EQ(find_fine_parts(sphere, 3.0).vertices, vertices);
  // Curvature around a vertex of valence 5 comes out up to a fifth too high.
  EXPECT_GE(find_fine_parts(sphere, 3.0).growth, 3.0);
  EXPECT_LE(find_fine_parts(sphere, 3.0).growth, 3.6);
}

TEST(FindFineParts, GrowsWithTheSurface) {
  TriMesh sphere = make_shape("sphere", {}, 0.1);
  scale(sphere, find_fine_parts(sphere, 3.0).growth);
  EXPECT_LE(find_fine_parts(sphere, 3.0).vertices, static_cast<int>(sphere.n_vertices()) / 1000);
}

}  // namespace
}  // namespace trivalent::remesh
