#include "trivalent/remesh/defects.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

TEST(FindDefects, OfAnIcosahedronAreTwelveLoneFives) {
  const Defects defects = find_defects(testing_support::icosahedron());
  EXPECT_EQ(defects.lone_5, 12);
  EXPECT_EQ(defects.lone_7, 0);
  EXPECT_EQ(defects.pairs, 0);
}

TEST(FindDefects, OfALatticeAreNone) {
  const Defects defects = find_defects(testing_support::triangular_sheet(6, 6));
  EXPECT_EQ(defects.lone_5 + defects.lone_7 + defects.pairs, 0);
}

TEST(FindDefects, OfAFlipAreTwoPairs) {
  TriMesh sheet = testing_support::triangular_sheet(12, 12);
  const int middle = 6 * 13 + 6;
  const auto h = sheet.find_halfedge(VertexHandle(middle), VertexHandle(middle + 1));
  sheet.flip(sheet.edge_handle(h));
  const Defects defects = find_defects(sheet);
  EXPECT_EQ(defects.pairs, 2);
  EXPECT_EQ(defects.lone_5 + defects.lone_7, 0);
}

TEST(FindDefects, OfAScarAreItsPairsAndOneDisclination) {
  // Around a pole of an icosphere a flip next to the vertex of valence 5 makes it a 6, and a row of
  // one 7 and two 5s.
  TriMesh sphere = make_shape("sphere", {}, 0.2);
  const int lone = find_defects(sphere).lone_5;
  const auto five = std::ranges::find_if(sphere.vertices_begin(), sphere.vertices_end(),
                                         [&](VertexHandle v) { return sphere.valence(v) == 5; });
  ASSERT_NE(five, sphere.vertices_end());
  const HalfedgeHandle spoke = *sphere.cvoh_iter(*five);
  sphere.flip(sphere.edge_handle(sphere.next_halfedge_handle(spoke)));
  const Defects defects = find_defects(sphere);
  EXPECT_EQ(defects.lone_5 - defects.lone_7, lone);
  EXPECT_EQ(defects.lone_7, 0);
  EXPECT_GE(defects.pairs, 1);
}

}  // namespace
}  // namespace trivalent::remesh
