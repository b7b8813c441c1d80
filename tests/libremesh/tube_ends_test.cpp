#include "trivalent/remesh/tube_ends.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "crystal/defect_moves.h"
#include "crystal/patch_topology.h"
#include "crystal/rims.h"
#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "mesh_fixtures.h"
#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

/// The triangulation of a (n,m) tube along z with edges of length 1 before it was rolled up: all
/// triangles of the lattice whose corners are less than `height` from the circle where it starts.
TriMesh tube_net(ChiralIndices tube, double height) {
  const Eigen::Vector2d a1(1.0, 0.0);
  const Eigen::Vector2d a2(0.5, 0.5 * std::numbers::sqrt3);
  const Eigen::Vector2d around = tube.n * a1 + tube.m * a2;
  const double length = around.norm();
  const Eigen::Vector2d along(-around.y() / length, around.x() / length);
  std::map<std::pair<int, int>, int> numbers;
  std::vector<Eigen::Vector3d> points;
  // Vertices that the circumference takes to each other are one.
  const auto vertex = [&](int i, int j) -> std::optional<int> {
    const Eigen::Vector2d p = i * a1 + j * a2;
    const double z = p.dot(along);
    if (z < -1e-9 || z > height) return std::nullopt;
    const int turns = static_cast<int>(std::floor(p.dot(around) / (length * length) + 1e-9));
    const auto [at, is_new] = numbers.try_emplace({i - turns * tube.n, j - turns * tube.m},
                                                  static_cast<int>(points.size()));
    if (is_new) {
      const double angle = 2.0 * std::numbers::pi * p.dot(around) / (length * length);
      const double radius = length / (2.0 * std::numbers::pi);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return at->second;
  };
  std::vector<std::array<int, 3>> triangles;
  const int reach = 3 * (tube.n + tube.m) + static_cast<int>(2.0 * height);
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const double turns = (i * a1 + j * a2).dot(around) / (length * length);
      if (turns < -1e-9 || turns > 1.0 - 1e-9) continue;
      const auto p = vertex(i, j);
      const auto right = vertex(i + 1, j);
      const auto above = vertex(i, j + 1);
      const auto left = vertex(i - 1, j + 1);
      if (p && right && above) triangles.push_back({*p, *right, *above});
      if (p && above && left) triangles.push_back({*p, *above, *left});
    }
  }
  return make_mesh(points, triangles);
}

TEST(TubeEnds, AreThoseOfTheTubeThatANetIsPartOf) {
  for (const ChiralIndices tube :
       {ChiralIndices{6, 0}, ChiralIndices{5, 5}, ChiralIndices{12, 5}, ChiralIndices{3, 7}}) {
    const auto ends = find_tube_ends(tube_net(tube, 6.0));
    ASSERT_EQ(ends.size(), 2u) << tube.n << ' ' << tube.m;
    for (const auto& end : ends) EXPECT_EQ(end, tube) << tube.n << ' ' << tube.m;
  }
}

TEST(TubeEnds, AreNoneWhereANetTurnsAlongItsBoundary) {
  const auto ends = find_tube_ends(testing_support::triangular_sheet(6, 4));
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_FALSE(ends.front().has_value());
  EXPECT_TRUE(find_tube_ends(testing_support::icosahedron()).empty());
}

TEST(TubeEnds, AreNoneAlongAPeriodicRibbon) {
  // Eight columns and four rows of triangles, joined along x.
  constexpr int columns = 8;
  constexpr int rows = 4;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  const auto number = [](int i, int j) { return j * columns + i % columns; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      points.emplace_back(i + 0.5 * j, 0.5 * std::numbers::sqrt3 * j, 0.0);
      if (j == rows) continue;
      triangles.push_back({number(i, j), number(i + 1, j), number(i, j + 1)});
      triangles.push_back({number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  TriMesh ribbon = make_mesh(points, triangles);
  EXPECT_EQ(find_tube_ends(ribbon).front(), (ChiralIndices{columns, 0}));  // as a tube
  ribbon.lattice = Lattice(Eigen::Vector3d(columns, 20.0, 20.0).asDiagonal().toDenseMatrix(),
                           {true, false, false});
  const auto ends = find_tube_ends(ribbon);
  ASSERT_EQ(ends.size(), 2u);
  for (const auto& end : ends) EXPECT_FALSE(end.has_value());
}

TEST(TubeEnds, CircumferencesAreThoseOfTheLattice) {
  EXPECT_DOUBLE_EQ(circumference_of({7, 0}), 7.0);
  EXPECT_DOUBLE_EQ(circumference_of({10, 10}), 10.0 * std::numbers::sqrt3);
  EXPECT_DOUBLE_EQ(circumference_of({8, 3}), std::sqrt(97.0));
}

TEST(TubeEnds, AreKeptByTheSurface) {
  TriMesh surface = make_shape("y-junction", {{"open", 1.0}, {"n", 8.0}, {"m", 4.0}}, 0.3);
  for (const ChiralIndices& tube : wanted_tube_ends(surface)) {
    EXPECT_EQ(tube, (ChiralIndices{8, 4}));
  }
  EXPECT_EQ(wanted_tube_ends(surface).size(), 3u);
  const double before = edge_length_of_tubes(surface).value();
  EXPECT_NEAR(before, 2.0 * std::numbers::pi / circumference_of({8, 4}), 0.01 * before);
  scale(surface, 2.0);
  EXPECT_NEAR(edge_length_of_tubes(surface).value(), 2.0 * before, 1e-12);
  const FeatureCurves curves(surface);
  for (const FeatureCurves::Boundary& boundary : curves.boundaries()) {
    EXPECT_EQ(boundary.tube, (ChiralIndices{8, 4}));
  }
  EXPECT_FALSE(edge_length_of_tubes(make_shape("open-tube", {}, 0.3)).has_value());
}

/// Moves at the open edges of a net.
TEST(Rims, AreForeseenBeforeAMoveIsMade) {
  TriMesh mesh = make_shape("open-tube", {}, 0.35);
  ConstrainedMesh net(mesh);
  PatchMarks marks;
  int made = 0;
  std::uint64_t random = 5;
  for (int tries = 0; tries < 400; ++tries) {
    random = hashed(random, 1);
    const VertexHandle center(static_cast<int>(random % mesh.n_vertices()));
    PatchTopology patch(net, center, {.inner = 3, .known = 3}, marks);
    if (!patch.is_whole() || patch.is_on_feature(0) != (tries % 2 == 0)) continue;
    const int spoke = patch.neighbor(0, static_cast<int>(random % 3));
    const bool changed = tries % 3 == 0   ? patch.flip(0, spoke)
                         : tries % 3 == 1 ? patch.collapse(0, spoke)
                                          : patch.split(0, spoke);
    if (!changed) continue;
    const std::vector<Rim> foreseen = rims_after(net, patch);
    const std::vector<VertexHandle> vertices = change_connectivity(net, patch);
    if (patch.is_inside(patch.added())) {
      Anchor anchor = net.anchor(center);
      anchor.kind = patch.is_open(patch.added()) ? FeatureKind::curve : FeatureKind::none;
      net.set_anchor(vertices[index(patch.added())], anchor);
    }
    mesh.garbage_collection();
    const std::vector<Rim> rims = find_rims(net);
    ASSERT_EQ(rims.size(), 2u);
    for (const Rim& rim : foreseen) {
      const LatticePath& found = rims[index(rim.boundary)].path;
      EXPECT_EQ(rim.path.edges, found.edges);
      EXPECT_EQ(rim.path.deviation, found.deviation);
      // Where the path closes without a turn, its sum does not depend on where it starts.
      if (found.deviation != 0) continue;
      EXPECT_EQ(rim.path.sum.squaredNorm() == 0, found.sum.squaredNorm() == 0);
      const auto ends = find_tube_ends(mesh);
      EXPECT_NEAR(rim.path.distance_to(ends[index(rim.boundary)].value()), 0.0, 1e-12);
    }
    made += static_cast<int>(!foreseen.empty());
  }
  EXPECT_GT(made, 50);
}

TEST(Rims, CostTheirTurnsAndTheirTubes) {
  const TriMesh net = tube_net({6, 2}, 5.0);
  TriMesh surface = net;
  const Membrane membrane;
  const ConstrainedMesh free(surface);
  EXPECT_NEAR(rim_energy(membrane, free), 0.0, 0.5);  // nothing but chords
  for (const auto v : surface.vertices()) {
    if (v.is_boundary()) set_tube_end(surface, v, {6, 2});
  }
  EXPECT_NEAR(rim_energy(membrane, ConstrainedMesh(surface)), 0.0, 1.0);
  for (const auto v : surface.vertices()) {
    if (v.is_boundary()) set_tube_end(surface, v, {7, 1});
  }
  EXPECT_GT(rim_energy(membrane, ConstrainedMesh(surface)), 5.0);
}

TEST(Rims, AreDividedOnlyWithTheirTubes) {
  TriMesh surface = tube_net({8, 4}, 5.0);
  for (const auto v : surface.vertices()) {
    if (v.is_boundary()) set_tube_end(surface, v, {8, 4});
  }
  const FeatureCurves curves(surface);
  EXPECT_TRUE(fits_tubes(curves, 1));
  EXPECT_TRUE(fits_tubes(curves, 4));
  EXPECT_FALSE(fits_tubes(curves, 8));
  EXPECT_TRUE(fits_tubes(FeatureCurves(tube_net({8, 4}, 5.0)), 8));
}

CrystalOptions quick_net_in_space(double edge_length) {
  return {.target_edge_length = edge_length, .effort = Effort::quick, .rest = NetRest::in_space};
}

TEST(Crystallize, EndsInTheTubesThatWereSaid) {
  const TriMesh surface = make_shape("junction",
                                     {{.name = "arm", .list = {1, 0, 0, 4, 8, 0}},
                                      {.name = "arm", .list = {-0.5, 1, 0, 4, 8, 0}},
                                      {.name = "arm", .list = {-0.5, -1, 0, 4, 6, 3}},
                                      {"open", 1.0}},
                                     0.2);
  const double edge_length = edge_length_of_tubes(surface).value();
  const TriMesh net = crystallize(surface, quick_net_in_space(edge_length)).mesh;
  std::map<std::pair<int, int>, int> found;
  for (const auto& tube : find_tube_ends(net)) {
    ASSERT_TRUE(tube.has_value());
    ++found[{tube->n, tube->m}];
  }
  EXPECT_EQ(found, (std::map<std::pair<int, int>, int>{{{8, 0}, 2}, {{6, 3}, 1}}));
  // With ends that do not turn, six more heptagons than pentagons belong to three arms.
  int sum = 0;
  for (const auto v : net.vertices()) {
    if (!v.is_boundary()) sum += static_cast<int>(v.valence()) - 6;
  }
  EXPECT_EQ(sum, 6);
}

TEST(Crystallize, LeavesOpenEndsAsStraightAsTheirSurface) {
  const TriMesh tube = make_shape("open-tube", {{"radius", 1.0}, {"length", 3.0}}, 0.15);
  const TriMesh net = crystallize(tube, quick_net_in_space(0.5)).mesh;
  for (const auto& end : find_tube_ends(net)) EXPECT_TRUE(end.has_value());
}

TEST(Crystallize, RefusesTubesThatItsNetsCannotEndIn) {
  const TriMesh surface = make_shape("y-junction", {{"open", 1.0}, {"n", 6.0}, {"m", 6.0}}, 0.2);
  const double edge_length = edge_length_of_tubes(surface).value();
  CrystalOptions options = quick_net_in_space(1.1 * edge_length);
  EXPECT_THROW(static_cast<void>(crystallize(surface, options)), InvalidOption);
  options = quick_net_in_space(edge_length);
  options.rest = NetRest::on_surface;
  EXPECT_THROW(static_cast<void>(crystallize(surface, options)), InvalidOption);
}

}  // namespace
}  // namespace trivalent::remesh
