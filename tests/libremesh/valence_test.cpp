#include "equalize/valence.h"

#include <gtest/gtest.h>

#include "mesh_fixtures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

int total_irregularity(const TriMesh& mesh) {
  int sum = 0;
  for (const int deviation : valence_deviations(mesh)) sum += deviation * deviation;
  return sum;
}

TEST(ValenceDeviations, AreZeroInsideARegularSheetAndTwelveOnAnIcosahedron) {
  const TriMesh sheet = testing_support::triangular_sheet(4, 4);
  const std::vector<int> deviations = valence_deviations(sheet);
  for (const auto v : sheet.vertices()) {
    if (v.is_boundary()) continue;
    EXPECT_EQ(deviations[index(v)], 0);
  }
  EXPECT_EQ(total_irregularity(testing_support::icosahedron()), 12);
}

TEST(CorrectValences, UndoesAFlipInARegularSheet) {
  TriMesh sheet = testing_support::triangular_sheet(6, 6);
  const int before = total_irregularity(sheet);
  EdgeHandle inside;
  for (const auto e : sheet.edges()) {
    if (!e.v0().is_boundary() && !e.v1().is_boundary()) inside = e;
  }
  ConstrainedMesh constrained(sheet);
  sheet.flip(inside);
  EXPECT_EQ(correct_valences(constrained), 1);
  EXPECT_EQ(total_irregularity(sheet), before);
}

TEST(CorrectValences, NeverMakesValencesWorseAndKeepsTheTopology) {
  TriMesh mesh = make_shape("double-torus", {}, 0.12);
  const int before = total_irregularity(mesh);
  const auto vertices = mesh.n_vertices();
  ConstrainedMesh constrained(mesh);
  EXPECT_GT(correct_valences(constrained), 0);
  EXPECT_LT(total_irregularity(mesh), before);
  EXPECT_EQ(mesh.n_vertices(), vertices);
  EXPECT_EQ(euler_characteristic(mesh), -2);
}

TEST(CorrectValences, FlipsNoCrease) {
  // Two flat fans that meet at a right angle in an edge whose flip would mend valences.
  TriMesh octahedron = testing_support::octahedron();
  ConstrainedMesh constrained(octahedron, find_creases(octahedron, 0.1));
  EXPECT_EQ(correct_valences(constrained), 0);
}

TEST(CorrectValences, TurnsNoFaceOver) {
  TriMesh tetrahedron = testing_support::tetrahedron();
  ConstrainedMesh constrained(tetrahedron);
  EXPECT_EQ(correct_valences(constrained), 0);
}

}  // namespace
}  // namespace trivalent::remesh
