#include "valence.h"

#include <gtest/gtest.h>

#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

int total_irregularity(const TriMesh& mesh) {
  int sum = 0;
  for (const auto v : mesh.vertices()) sum += irregularity(mesh, v, 0);
  return sum;
}

TEST(Irregularity, IsZeroInsideARegularSheet) {
  const TriMesh sheet = testing_support::triangular_sheet(4, 4);
  for (const auto v : sheet.vertices()) {
    if (v.is_boundary()) continue;
    EXPECT_EQ(irregularity(sheet, v, 0), 0);
    EXPECT_EQ(irregularity(sheet, v, -2), 4);
  }
}

TEST(CorrectValences, UndoesAFlipInARegularSheet) {
  TriMesh sheet = testing_support::triangular_sheet(6, 6);
  const auto regular = triangles_of(sheet);
  EdgeHandle inside;
  for (const auto e : sheet.edges()) {
    if (!e.v0().is_boundary() && !e.v1().is_boundary()) inside = e;
  }
  ConstrainedMesh constrained(sheet, std::nullopt);
  sheet.flip(inside);
  EXPECT_EQ(correct_valences(constrained), 1);
  EXPECT_EQ(total_irregularity(sheet), total_irregularity(make_mesh(
                                           [&] {
                                             std::vector<Eigen::Vector3d> points;
                                             for (const auto v : sheet.vertices())
                                               points.push_back(sheet.point(v));
                                             return points;
                                           }(),
                                           regular)));
}

TEST(CorrectValences, NeverMakesValencesWorseAndKeepsTheTopology) {
  TriMesh mesh = make_shape("double-torus", {}, 0.12);
  const int before = total_irregularity(mesh);
  const auto vertices = mesh.n_vertices();
  ConstrainedMesh constrained(mesh, std::nullopt);
  EXPECT_GT(correct_valences(constrained), 0);
  EXPECT_LT(total_irregularity(mesh), before);
  EXPECT_EQ(mesh.n_vertices(), vertices);
  EXPECT_EQ(testing_support::euler_characteristic(mesh), -2);
}

TEST(CorrectValences, FlipsNoCrease) {
  // Two flat fans that meet at a right angle in an edge whose flip would mend valences.
  TriMesh octahedron = testing_support::octahedron();
  ConstrainedMesh constrained(octahedron, 0.1);
  EXPECT_EQ(correct_valences(constrained), 0);
}

TEST(CorrectValences, TurnsNoFaceOver) {
  TriMesh tetrahedron = testing_support::tetrahedron();
  ConstrainedMesh constrained(tetrahedron, std::nullopt);
  EXPECT_EQ(correct_valences(constrained), 0);
}

}  // namespace
}  // namespace trivalent::remesh
