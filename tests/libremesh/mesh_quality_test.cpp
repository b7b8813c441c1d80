#include "trivalent/remesh/mesh_quality.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

using std::numbers::pi;
using testing_support::icosahedron;
using testing_support::octahedron;
using testing_support::tetrahedron;
using testing_support::triangular_sheet;

using Valences = std::map<int, int>;
using Triangles = std::vector<std::array<int, 3>>;

/// Both meshes as one, side by side in memory wherever they lie in space.
TriMesh together(const TriMesh& a, const TriMesh& b) {
  std::vector<Eigen::Vector3d> points;
  Triangles triangles = triangles_of(a);
  for (const auto v : a.vertices()) points.push_back(a.point(v));
  for (const auto v : b.vertices()) points.push_back(b.point(v));
  for (auto triangle : triangles_of(b)) {
    for (int& v : triangle) v += static_cast<int>(a.n_vertices());
    triangles.push_back(triangle);
  }
  return make_mesh(points, triangles);
}

TriMesh moved(TriMesh mesh, const Eigen::Vector3d& by) {
  for (const auto v : mesh.vertices()) mesh.point(v) += by;
  return mesh;
}

// ---- regularity --------------------------------------------------------------------------------

TEST(MeasureQuality, OfTheIcosahedron) {
  const MeshQuality quality = measure_quality(icosahedron());
  EXPECT_EQ(quality.vertices, 12);
  EXPECT_EQ(quality.edges, 30);
  EXPECT_EQ(quality.faces, 20);
  EXPECT_EQ(quality.euler_characteristic, 2);
  EXPECT_EQ(quality.components, 1);
  EXPECT_EQ(quality.boundary_loops, 0);
  EXPECT_NEAR(quality.edge_length.mean, 2.0, 1e-15);
  EXPECT_NEAR(quality.edge_length.relative(), 0.0, 1e-15);
  EXPECT_EQ(quality.valences, (Valences{{5, 12}}));
  EXPECT_EQ(quality.regular_fraction, 0.0);
  EXPECT_NEAR(quality.smallest_angle, pi / 3.0, 1e-15);
  EXPECT_NEAR(quality.largest_angle, pi / 3.0, 1e-15);
  EXPECT_EQ(quality.self_intersections, 0);
}

TEST(MeasureQuality, OfAFlatSheet) {
  const MeshQuality quality = measure_quality(triangular_sheet(5, 4));
  EXPECT_EQ(quality.euler_characteristic, 1);
  EXPECT_EQ(quality.boundary_loops, 1);
  // Boundary vertices have no ring and are not counted.
  EXPECT_EQ(quality.valences, (Valences{{6, 4 * 3}}));
  EXPECT_EQ(quality.regular_fraction, 1.0);
  EXPECT_EQ(quality.self_intersections, 0);
}

TEST(MeasureQuality, GivesThePopulationsStandardDeviation) {
  // Right-angled tetrahedron: three edges of 1, three of √2.
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const MeshQuality quality =
      measure_quality(make_mesh(points, Triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}));
  EXPECT_NEAR(quality.edge_length.mean, (1.0 + std::sqrt(2.0)) / 2.0, 1e-15);
  EXPECT_NEAR(quality.edge_length.standard_deviation, (std::sqrt(2.0) - 1.0) / 2.0, 1e-15);
  EXPECT_NEAR(quality.edge_length.min, 1.0, 1e-15);
  EXPECT_NEAR(quality.edge_length.max, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(quality.smallest_angle, pi / 4.0, 1e-15);
  EXPECT_NEAR(quality.largest_angle, pi / 2.0, 1e-15);
}

TEST(MeasureQuality, CountsBoundaryLoopsAndComponents) {
  const MeshQuality tube = measure_quality(make_shape("open-tube", {}, 0.3));
  EXPECT_EQ(tube.boundary_loops, 2);
  EXPECT_EQ(tube.euler_characteristic, 0);
  const MeshQuality both =
      measure_quality(together(icosahedron(), moved(triangular_sheet(2, 2), {9, 9, 9})));
  EXPECT_EQ(both.components, 2);
  EXPECT_EQ(both.boundary_loops, 1);
  EXPECT_EQ(both.euler_characteristic, 3);
}

TEST(MeasureQuality, DoesNotCountIsolatedVertices) {
  TriMesh mesh = icosahedron();
  mesh.add_vertex({5, 5, 5});
  const MeshQuality quality = measure_quality(mesh);
  EXPECT_EQ(quality.vertices, 12);
  EXPECT_EQ(quality.euler_characteristic, 2);
  EXPECT_EQ(quality.valences, (Valences{{5, 12}}));
}

TEST(MeasureQuality, OfNothingIsNothing) {
  const MeshQuality quality = measure_quality(TriMesh());
  EXPECT_EQ(quality.vertices, 0);
  EXPECT_EQ(quality.components, 0);
  EXPECT_EQ(quality.edge_length.relative(), 0.0);
  EXPECT_EQ(quality.largest_angle, 0.0);
}

// ---- self-intersections ------------------------------------------------------------------------

TEST(SelfIntersections, AreNoneInClosedShapes) {
  for (const auto* name : {"sphere", "torus", "double-torus", "capsule", "tube", "wavy-sheet"}) {
    EXPECT_EQ(measure_quality(make_shape(name, {}, 0.15)).self_intersections, 0) << name;
  }
}

TEST(SelfIntersections, AreCountedInPairs) {
  // A needle through the sheet: its three long faces each cross the one triangle they pass.
  const std::vector<Eigen::Vector3d> needle = {
      {1.0, 0.2, 1}, {1.01, 0.2, 1}, {1.0, 0.21, 1}, {1.0, 0.2, -1}};
  const TriMesh pin = make_mesh(needle, Triangles{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  EXPECT_EQ(measure_quality(together(triangular_sheet(2, 2), pin)).self_intersections, 3);
}

TEST(SelfIntersections, AreFoundBetweenSpheres) {
  const TriMesh sphere = make_shape("sphere", {}, 0.2);
  EXPECT_EQ(measure_quality(together(sphere, moved(sphere, {2.1, 0, 0}))).self_intersections, 0);
  EXPECT_GT(measure_quality(together(sphere, moved(sphere, {1.0, 0, 0}))).self_intersections, 40);
  // Each face upon its copy, and upon the neighbors that touch it.
  EXPECT_GE(measure_quality(together(sphere, sphere)).self_intersections,
            static_cast<int>(sphere.n_faces()));
}

TEST(SelfIntersections, AreFoundBetweenFacesThatShareAVertex) {
  // Two flaps at vertex 0 in a fan; the tip of the second pierces the first, or stops short of it.
  const auto flaps = [](double reach) {
    const std::vector<Eigen::Vector3d> points = {
        {0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {0.5, 0.6, 1}, {1, 0, reach}};
    return make_mesh(points, Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  };
  EXPECT_EQ(measure_quality(flaps(0.5)).self_intersections, 0);
  EXPECT_EQ(measure_quality(flaps(-0.5)).self_intersections, 1);
}

TEST(SelfIntersections, AreFoundInAFlatFold) {
  const auto fold = [](double x, double z) {
    const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {x, 0.5, z}};
    return make_mesh(points, Triangles{{0, 2, 1}, {0, 1, 3}});
  };
  EXPECT_EQ(measure_quality(fold(-1.0, 0.0)).self_intersections, 0);
  EXPECT_EQ(measure_quality(fold(0.5, 0.0)).self_intersections, 1);
  EXPECT_EQ(measure_quality(fold(0.5, 1e-300)).self_intersections, 0);
}

// ---- distances ---------------------------------------------------------------------------------

TEST(MeasureDistance, IsZeroToItself) {
  const TriMesh mesh = make_shape("torus", {}, 0.2);
  const TwoSidedDistance distance = measure_distance(mesh, mesh, 1000);
  // Rounding of sample positions, some units in the last place of coordinates of about 1.
  EXPECT_LT(distance.max(), 1e-15);
  EXPECT_EQ(distance.diagonal, bounding_box(mesh).diagonal());
}

TEST(MeasureDistance, BetweenParallelSheetsIsTheirGap) {
  const TriMesh sheet = triangular_sheet(10, 10);
  const TwoSidedDistance distance = measure_distance(moved(sheet, {0, 0, 0.25}), sheet, 1000);
  for (const auto& side : {distance.to_original, distance.from_original}) {
    EXPECT_NEAR(side.max, 0.25, 1e-14);
    EXPECT_NEAR(side.mean, 0.25, 1e-14);
    EXPECT_NEAR(side.root_mean_square, 0.25, 1e-14);
  }
}

TEST(MeasureDistance, BetweenConcentricSpheresIsTheDifferenceOfRadii) {
  const TriMesh inner = make_shape("sphere", {{"radius", 1.0}}, 0.04);
  const TriMesh outer = make_shape("sphere", {{"radius", 1.5}}, 0.04);
  const TwoSidedDistance distance = measure_distance(outer, inner, 20000);
  // Flat triangles of edge L, here up to 0.045, lie up to L²/(6 R) inside the sphere.
  EXPECT_NEAR(distance.max(), 0.5, 3.5e-4);
  EXPECT_NEAR(distance.to_original.mean, 0.5, 3.5e-4);
  EXPECT_NEAR(distance.from_original.root_mean_square, 0.5, 3.5e-4);
}

TEST(MeasureDistance, LooksAtEveryVertex) {
  // One spike among many faces; a few samples would miss it.
  TriMesh spiked = triangular_sheet(60, 60);
  spiked.point(VertexHandle(61 * 30 + 30)).z() = 2.0;
  const TwoSidedDistance distance = measure_distance(spiked, triangular_sheet(60, 60), 10);
  EXPECT_NEAR(distance.to_original.max, 2.0, 1e-14);
}

TEST(MeasureDistance, SamplesByArea) {
  // A large triangle at height 1 and many small ones at height 0 with 1/10 of its area.
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 1}, {10, 0, 1}, {0, 10, 1}};
  const TriMesh large = make_mesh(corners, Triangles{{0, 1, 2}});
  TriMesh small = triangular_sheet(20, 20);
  scale(small, std::sqrt(5.0 / surface_area(small)));
  const std::vector<Eigen::Vector3d> ground = {{-100, -100, 0}, {100, -100, 0}, {0, 200, 0}};
  const auto distance =
      measure_distance(together(large, small), make_mesh(ground, Triangles{{0, 1, 2}}), 11000);
  // Stratified: off by at most one sample.
  EXPECT_NEAR(distance.to_original.mean, 50.0 / 55.0, 1.01 / 11000);
}

TEST(MeasureDistance, DoesNotDependOnTheNumberOfThreads) {
  const TriMesh a = make_shape("double-torus", {}, 0.1), b = make_shape("double-torus", {}, 0.07);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const TwoSidedDistance d = measure_distance(a, b, 5000);
    return std::vector<double>{
        d.to_original.max,   d.to_original.mean,   d.to_original.root_mean_square,
        d.from_original.max, d.from_original.mean, d.from_original.root_mean_square};
  };
  EXPECT_EQ(with_threads(1), with_threads(7));
}

TEST(MeasureDistance, ScalesWithTheMeshes) {
  TriMesh a = octahedron(), b = tetrahedron();
  const double before = measure_distance(a, b, 1000).max();
  for (const double factor : {1e-6, 1e6}) {
    TriMesh large_a = a, large_b = b;
    scale(large_a, factor);
    scale(large_b, factor);
    EXPECT_NEAR(measure_distance(large_a, large_b, 1000).max(), factor * before, 1e-13 * factor);
  }
}

TEST(MeasureDistance, ThrowsOnAMeshWithoutArea) {
  EXPECT_THROW((void)measure_distance(TriMesh(), icosahedron(), 10), InvalidMesh);
  EXPECT_THROW((void)measure_distance(icosahedron(), TriMesh(), 10), InvalidMesh);
}

TEST(MeasureDistance, ThrowsOnTooFewSamples) {
  EXPECT_THROW((void)measure_distance(icosahedron(), icosahedron(), 0), InvalidOption);
}

}  // namespace
}  // namespace trivalent::remesh
