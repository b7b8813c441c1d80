#include "trivalent/remesh/remesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "mesh/surface_projector.h"
#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

/// The figures that the method promises on a smooth surface, [Pecanha2013, Tables 1 and 2].
void expect_equalized(const TriMesh& mesh, double target) {
  const MeshQuality quality = measure_quality(mesh);
  EXPECT_NEAR(quality.edge_length.mean, target, 0.02 * target);
  EXPECT_LT(quality.edge_length.relative(), 0.10);
  EXPECT_GT(quality.regular_fraction, 0.78);
  EXPECT_EQ(quality.self_intersections, 0);
}

class RemeshFactor : public testing::TestWithParam<double> {};

TEST_P(RemeshFactor, EqualizesATorusFinerAndCoarser) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  const double target = GetParam() * mean_edge_length(torus);
  const RemeshResult result = remesh(torus, {.target_edge_length = target});
  EXPECT_EQ(euler_characteristic(result.mesh), 0);
  EXPECT_TRUE(testing_support::is_closed(result.mesh));
  expect_equalized(result.mesh, target);
}
INSTANTIATE_TEST_SUITE_P(FromFinerToCoarser, RemeshFactor, testing::Values(0.25, 0.5, 1.0, 1.5));

TEST(Remesh, CoarsensEightTimes) {
  const TriMesh sphere = make_shape("sphere", {}, 0.025);
  const double target = 8.0 * mean_edge_length(sphere);
  const TriMesh coarse = remesh(sphere, {.target_edge_length = target}).mesh;
  EXPECT_EQ(euler_characteristic(coarse), 2);
  expect_equalized(coarse, target);
}

/// A cylinder along z as CAD programs write it: a side of needles from end to end, lids as fans.
TriMesh needle_cylinder(int corners, double length) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const double z : {0.0, length}) {
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners;
      points.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  }
  points.emplace_back(0.0, 0.0, 0.0);
  points.emplace_back(0.0, 0.0, length);
  for (int a = 0; a < corners; ++a) {
    const int b = (a + 1) % corners;
    triangles.push_back({a, b, b + corners});
    triangles.push_back({a, b + corners, a + corners});
    triangles.push_back({2 * corners, b, a});
    triangles.push_back({2 * corners + 1, a + corners, b + corners});
  }
  return make_mesh(points, triangles);
}

TEST(Remesh, JoinsNeedlesBeforeItSplitsThem) {
  // Needles of 10000:1. Splitting them first would make 60 times the faces of the net.
  const TriMesh cylinder = needle_cylinder(1000, 63.0);
  int max_vertices = 0;
  const RemeshResult result =
      remesh(cylinder, {.target_edge_length = 0.5, .on_progress = [&](const RemeshProgress& state) {
                          max_vertices = std::max(max_vertices, state.vertices);
                        }});
  EXPECT_EQ(euler_characteristic(result.mesh), 2);
  EXPECT_LT(max_vertices, 2 * static_cast<int>(result.mesh.n_vertices()));
  EXPECT_LT(result.relative_spread, 0.15);
}

TEST(Remesh, DividesFansOfEdgesFarLongerThanTheTarget) {
  // Six rails of 500 edges: with one split a round at their ends, the mesh grew without end.
  const TriMesh prism = needle_cylinder(6, 500.0);
  std::size_t max_vertices = 0;
  const RemeshResult result = remesh(
      prism, {.target_edge_length = 1.0, .on_progress = [&](const RemeshProgress& state) {
                max_vertices = std::max(max_vertices, static_cast<std::size_t>(state.vertices));
              }});
  EXPECT_EQ(euler_characteristic(result.mesh), 2);
  EXPECT_LT(max_vertices, 3 * result.mesh.n_vertices());
  EXPECT_LT(result.relative_spread, 0.15);
}

TEST(Remesh, KeepsEveryVertexOnTheOriginal) {
  const TriMesh original = make_shape("ellipsoid", {}, 0.2);
  const RemeshResult result = remesh(original, {.target_edge_length = 0.15});
  const SurfaceProjector surface(original);
  const double rounding = 1e-12 * bounding_box(original).diagonal();
  for (const auto v : result.mesh.vertices()) {
    const Eigen::Vector3d& p = result.mesh.point(v);
    ASSERT_LE((surface.nearest(p).position - p).norm(), rounding) << "vertex " << v.idx();
  }
}

TEST(Remesh, KeepsGenusTwo) {
  const TriMesh original = make_shape("double-torus", {}, 0.1);
  const RemeshResult result = remesh(original, {.target_edge_length = 0.12});
  EXPECT_EQ(euler_characteristic(result.mesh), -2);
  EXPECT_TRUE(testing_support::is_closed(result.mesh));
}

TEST(Remesh, LeastSquaresDoesAsWellAsHard) {
  const TriMesh sphere = make_shape("sphere", {}, 0.2);
  const RemeshResult result =
      remesh(sphere, {.target_edge_length = 0.1, .restriction = Restriction::least_squares});
  EXPECT_EQ(euler_characteristic(result.mesh), 2);
  expect_equalized(result.mesh, 0.1);
}

TEST(Remesh, KeepsAnOpenBoundaryInItsPlace) {
  const TriMesh sheet = make_shape("wavy-sheet", {}, 0.3);
  const RemeshResult result = remesh(sheet, {.target_edge_length = 0.2});
  EXPECT_EQ(euler_characteristic(result.mesh), 1);
  EXPECT_EQ(measure_quality(result.mesh).boundary_loops, 1);
  EXPECT_EQ(bounding_box(result.mesh).low.head<2>(), bounding_box(sheet).low.head<2>());
  EXPECT_EQ(bounding_box(result.mesh).high.head<2>(), bounding_box(sheet).high.head<2>());
}

TEST(Remesh, DoesNotDependOnTheNumberOfThreads) {
  const TriMesh original = make_shape("torus", {}, 0.2);
  const RemeshOptions options{.target_edge_length = 0.15, .iterations = 5};
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return remesh(original, options).mesh;
  };
  const TriMesh one = with_threads(1);
  const TriMesh many = with_threads(7);
  ASSERT_EQ(triangles_of(one), triangles_of(many));
  for (const auto v : one.vertices()) ASSERT_EQ(one.point(v), many.point(v));
}

TEST(Remesh, ScalesWithItsInput) {
  const double factor = 1048576.0;  // a power of two changes no digit
  TriMesh original = make_shape("torus", {}, 0.3);
  const TriMesh small = remesh(original, {.target_edge_length = 0.2, .iterations = 5}).mesh;
  scale(original, factor);
  const TriMesh large =
      remesh(original, {.target_edge_length = 0.2 * factor, .iterations = 5}).mesh;
  ASSERT_EQ(triangles_of(small), triangles_of(large));
  for (const auto v : small.vertices()) ASSERT_EQ(factor * small.point(v), large.point(v));
}

TEST(Remesh, EndsHoweverNarrowTheTolerance) {
  const TriMesh torus = make_shape("torus", {}, 0.3);
  for (const double tolerance : {1e-6, 0.1, 0.999}) {
    const RemeshResult result = remesh(
        torus, {.target_edge_length = 0.2, .iterations = 3, .rings = 1, .tolerance = tolerance});
    EXPECT_EQ(euler_characteristic(result.mesh), 0);
  }
}

TEST(Remesh, ReportsProgressAfterEveryIteration) {
  int calls = 0;
  RemeshOptions options{.target_edge_length = 0.5, .iterations = 3};
  options.on_progress = [&](const RemeshProgress& progress) {
    EXPECT_EQ(progress.iteration, ++calls);
    EXPECT_EQ(progress.iterations, 3);
    EXPECT_GT(progress.vertices, 3);
  };
  const RemeshResult result = remesh(make_shape("sphere", {}, 0.5), options);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(result.iterations, 3);
}

TEST(Remesh, ReturnsTheNetSoFarWhenStopped) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  RemeshOptions options{.target_edge_length = 0.15};
  int done = 0;
  options.on_progress = [&](const RemeshProgress& progress) { done = progress.iteration; };
  options.should_stop = [&] { return done == 3; };
  const RemeshResult result = remesh(torus, options);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_TRUE(testing_support::is_closed(result.mesh));
  options.should_stop = [] { return true; };
  EXPECT_THROW(static_cast<void>(remesh(torus, options)), Stopped);
}

TEST(Remesh, ThrowsOnAnEmptyMesh) {
  EXPECT_THROW((void)remesh(TriMesh(), {.target_edge_length = 1.0}), InvalidMesh);
}

TEST(Remesh, ThrowsOnAVertexWithoutAFace) {
  TriMesh mesh = make_shape("sphere", {}, 0.5);
  mesh.add_vertex({5.0, 5.0, 5.0});
  EXPECT_THROW((void)remesh(mesh, {.target_edge_length = 0.3}), InvalidMesh);
}

TEST(Remesh, ThrowsOnAMeshWhoseAreaIsZeroOrOverflows) {
  for (const double factor : {0.0, 1e300}) {
    TriMesh mesh = make_shape("sphere", {}, 0.5);
    scale(mesh, factor);
    EXPECT_THROW((void)remesh(mesh, {.target_edge_length = 0.3}), InvalidMesh) << factor;
  }
}

TEST(Remesh, ThrowsOnANeedleInsteadOfSplittingItForever) {
  TriMesh needle = make_shape("sphere", {}, 0.2);
  needle.point(VertexHandle(7)) = {0.0, 0.0, 1e11};
  EXPECT_THROW(remesh(needle, {.target_edge_length = 1e4}), InvalidOption);
}

TEST(Remesh, ThrowsOnATubeLeanerThanTheLeanestClosedNet) {
  // Tetrahedra face to face: 2 faces and m/√10 of length each.
  const double leanest = 2.0 * std::sqrt(3.0) / 4.0 * std::sqrt(10.0);
  const TriMesh tube = needle_cylinder(60, 200.0);
  const double longest = 2.0 * std::numbers::pi / leanest;
  EXPECT_THROW((void)remesh(tube, {.target_edge_length = 1.1 * longest}), InvalidOption);
  EXPECT_NO_THROW((void)remesh(tube, {.target_edge_length = 0.9 * longest, .iterations = 1}));
}

TEST(Remesh, ThrowsOnATargetThatNeedsTooManyFaces) {
  const TriMesh sphere = make_shape("sphere", {}, 0.5);
  EXPECT_THROW((void)remesh(sphere, {.target_edge_length = 1e-9}), InvalidOption);
}

TEST(Remesh, ThrowsOnOptionsOutOfRange) {
  const TriMesh sphere = make_shape("sphere", {}, 0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const RemeshOptions& options :
       {RemeshOptions{}, RemeshOptions{.target_edge_length = -1.0},
        RemeshOptions{.target_edge_length = nan},
        RemeshOptions{.target_edge_length = 0.3, .iterations = 0},
        RemeshOptions{.target_edge_length = 0.3, .rings = 0},
        RemeshOptions{.target_edge_length = 0.3, .rings = 9},
        RemeshOptions{.target_edge_length = 0.3, .tolerance = 0.0},
        RemeshOptions{.target_edge_length = 0.3, .tolerance = 1.0},
        RemeshOptions{.target_edge_length = 0.3, .feature_angle = 0.0}}) {
    EXPECT_THROW((void)remesh(sphere, options), InvalidOption);
  }
}

TEST(Remesh, ThrowsOnATargetThatTheShapeCannotHold) {
  const TriMesh sphere = make_shape("sphere", {}, 0.2);  // radius 1
  EXPECT_THROW((void)remesh(sphere, {.target_edge_length = 3.0}), InvalidOption);
}

}  // namespace
}  // namespace trivalent::remesh
