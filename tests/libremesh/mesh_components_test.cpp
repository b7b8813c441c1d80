#include "trivalent/remesh/mesh_components.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "mesh_fixtures.h"

namespace trivalent::remesh {
namespace {

using testing_support::icosahedron;
using testing_support::octahedron;
using testing_support::triangular_sheet;

/// A mesh, made `size` times as large and moved.
struct Placed {
  TriMesh mesh;
  double size = 1.0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

TriMesh join(const std::vector<Placed>& parts) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const Placed& part : parts) {
    const int first = static_cast<int>(points.size());
    for (const auto v : part.mesh.vertices()) {
      points.push_back(part.size * part.mesh.point(v) + part.shift);
    }
    for (const auto& [a, b, c] : triangles_of(part.mesh)) {
      triangles.push_back({first + a, first + b, first + c});
    }
  }
  return make_mesh(points, triangles);
}

TEST(FindComponents, MeasuresEveryPart) {
  const MeshComponents found =
      find_components(join({{octahedron(), 2.0, {9, 9, 9}}, {triangular_sheet(3, 2)}}));
  ASSERT_EQ(found.parts.size(), 2u);
  const MeshComponent& solid = found.parts[0];
  EXPECT_TRUE(solid.is_closed());
  EXPECT_EQ(solid.faces, 8);
  EXPECT_EQ(solid.euler_characteristic(), 2);
  // Edge √8: area 2√3 · edge², volume √2/3 · edge³.
  EXPECT_NEAR(solid.area, 16.0 * std::numbers::sqrt3, 1e-12);
  EXPECT_NEAR(solid.volume, 32.0 / 3.0, 1e-12);
  EXPECT_EQ(solid.box.low, Eigen::Vector3d(7, 7, 7));
  const MeshComponent& sheet = found.parts[1];
  EXPECT_FALSE(sheet.is_closed());
  EXPECT_EQ(sheet.boundary_edges, 10);
  EXPECT_EQ(sheet.euler_characteristic(), 1);
  EXPECT_EQ(sheet.volume, 0.0);
  for (int f = 0; f < 20; ++f) EXPECT_EQ(found.of_face[static_cast<std::size_t>(f)], f < 8 ? 0 : 1);
}

TEST(FindComponents, RecognizesNestedShells) {
  // An onion of three, a sheet inside the middle one, and a small neighbor within the box of the
  // largest but outside of it.
  const MeshComponents found = find_components(join({{icosahedron(), 2.0},
                                                     {icosahedron(), 6.0},
                                                     {icosahedron(), 4.0},
                                                     {triangular_sheet(1, 1), 0.5, {4.5, 0, 0}},
                                                     {octahedron(), 0.1, {9.2, 9.2, 9.2}}}));
  ASSERT_EQ(found.parts.size(), 5u);
  EXPECT_EQ(found.parts[0].inside_of, 2);
  EXPECT_EQ(found.parts[1].inside_of, std::nullopt);
  EXPECT_EQ(found.parts[2].inside_of, 1);
  EXPECT_EQ(found.parts[3].inside_of, 2);
  EXPECT_EQ(found.parts[4].inside_of, std::nullopt);
}

TEST(FindComponents, RecognizesNestingWhateverTheOrientation) {
  TriMesh cavity = octahedron();
  // Mirrored, so that it is inside out.
  for (const auto v : cavity.vertices()) cavity.point(v).x() *= -1.0;
  const MeshComponents found = find_components(join({{cavity}, {icosahedron(), 5.0}}));
  EXPECT_LT(found.parts[0].volume, 0.0);
  EXPECT_EQ(found.parts[0].inside_of, 1);
}

TEST(FindComponents, FindsNoneInAnEmptyMesh) { EXPECT_TRUE(find_components({}).parts.empty()); }

}  // namespace
}  // namespace trivalent::remesh
