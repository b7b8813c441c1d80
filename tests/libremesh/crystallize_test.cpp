#include "trivalent/remesh/crystallize.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

std::vector<Eigen::Vector3d> points_of(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
  return points;
}

/// A small task that takes a fraction of a second.
CrystalOptions quick(double target) {
  return {.target_edge_length = target, .effort = Effort::quick};
}

class Crystallize : public testing::TestWithParam<const char*> {};

TEST_P(Crystallize, MakesAlmostPerfectNetsOnClosedSurfaces) {
  const TriMesh surface = make_shape(GetParam(), {}, 0.1);
  const double target = 0.12;
  const RemeshResult result = crystallize(surface, {.target_edge_length = target});
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_TRUE(testing_support::is_closed(result.mesh));
  EXPECT_EQ(quality.euler_characteristic, euler_characteristic(surface));
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_NEAR(quality.edge_length.mean, target, 0.01 * target);
  EXPECT_LT(quality.edge_length.relative(), 0.045);
  EXPECT_GT(quality.regular_fraction, 0.94);
  EXPECT_GE(quality.valences.begin()->first, 5);
  EXPECT_LE(quality.valences.rbegin()->first, 7);
}
INSTANTIATE_TEST_SUITE_P(Shapes, Crystallize, testing::Values("sphere", "torus", "double-torus"));

TEST(CrystallizeNet, NeedsNoScarsOnASphere) {
  // Where defects cannot buckle, a sphere of this size has three pairs at every pentagon.
  const TriMesh sphere = make_shape("sphere", {}, 0.05);
  const CrystalOptions options = {.target_edge_length = 0.08, .rest = NetRest::in_space};
  EXPECT_LE(measure_quality(crystallize(sphere, options).mesh).valences[7], 6);
}

TEST(CrystallizeNet, HasTwelvePentagonsAndNoPairsOnASmallSphere) {
  const TriMesh sphere = make_shape("sphere", {}, 0.05);
  const double target = std::sqrt(surface_area(sphere) / (std::sqrt(3.0) / 4.0 * 960.0));
  const CrystalOptions options = {.target_edge_length = target, .rest = NetRest::in_space};
  const auto valences = measure_quality(crystallize(sphere, options).mesh).valences;
  EXPECT_EQ(valences.at(5), 12);
  EXPECT_EQ(valences.size(), 2U);
}

TEST(CrystallizeNet, HasTheFacesThatFitTheArea) {
  const TriMesh torus = make_shape("torus", {}, 0.1);
  const double target = 0.12;
  CrystalOptions options = quick(target);
  options.rest = NetRest::in_space;
  const TriMesh net = crystallize(torus, options).mesh;
  const double faces = surface_area(torus) / (std::sqrt(3.0) / 4.0 * target * target);
  EXPECT_NEAR(static_cast<double>(net.n_faces()), faces, 0.02 * faces);
}

TEST(CrystallizeNet, FollowsAsCloselyAsAsked) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  double last = 0.0;
  for (const Follow follow : {Follow::close, Follow::free}) {
    CrystalOptions options = quick(0.12);
    options.rest = NetRest::in_space;
    options.follow = follow;
    const double distance =
        measure_distance(crystallize(sphere, options).mesh, sphere).root_mean_square();
    EXPECT_GT(distance, last);
    last = distance;
  }
}

TEST(CrystallizeNet, BeginsCoarseThoughPartsAreThin) {
  // Ears and tusks are thinner than the coarse net's edges.
  const auto path = std::filesystem::path(TRIVALENT_MESHES) / "elephant.off";
  const TriMesh elephant = read_mesh(path).mesh;
  const RemeshResult result = crystallize(elephant, quick(0.012));
  EXPECT_TRUE(result.coarse_start);
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_EQ(quality.euler_characteristic, euler_characteristic(elephant));
  EXPECT_GT(quality.regular_fraction, 0.94);
  EXPECT_LT(measure_distance(result.mesh, elephant).max(), 0.012);  // tips are reached
}

TEST(CrystallizeNet, LiesOnBothSidesOfThinPlates) {
  // Twice as thick as the edges are long, with a sharp rim.
  TriMesh plate = make_shape("sphere", {}, 0.1);
  for (const auto v : plate.vertices()) plate.point(v).z() *= 0.1;
  const double target = 0.1;
  const RemeshResult result = crystallize(plate, {.target_edge_length = target});
  EXPECT_TRUE(result.coarse_start);
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_EQ(quality.euler_characteristic, 2);
  EXPECT_GT(quality.regular_fraction, 0.94);
  EXPECT_LT(quality.edge_length.relative(), 0.05);
  EXPECT_NEAR(quality.edge_length.mean, target, 0.02 * target);
  EXPECT_GE(quality.valences.begin()->first, 5);
  EXPECT_LE(quality.valences.rbegin()->first, 7);
  EXPECT_LT(measure_distance(result.mesh, plate).max(), 1.2 * target);
}

TEST(CrystallizeNet, KeepsPlatesThatHaveNoRoomForACoarseNet) {
  // 1.2 times as thick as the edges are long.
  TriMesh plate = make_shape("sphere", {}, 0.05);
  for (const auto v : plate.vertices()) plate.point(v).z() *= 0.1;
  const double target = 0.17;
  const RemeshResult result = crystallize(plate, quick(target));
  EXPECT_FALSE(result.coarse_start);
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_EQ(quality.euler_characteristic, 2);
  EXPECT_LT(quality.edge_length.relative(), 0.08);
  EXPECT_LT(measure_distance(result.mesh, plate).max(), 1.5 * target);
}

TEST(CrystallizeNet, IsTheSameOnAnyNumberOfThreads) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  std::vector<std::vector<Eigen::Vector3d>> nets;
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    nets.push_back(points_of(crystallize(torus, quick(0.15)).mesh));
  }
  EXPECT_EQ(nets[0], nets[1]);
}

TEST(CrystallizeNet, IsTheSameInSpaceOnAnyNumberOfThreads) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  CrystalOptions options = quick(0.12);
  options.rest = NetRest::in_space;
  std::vector<std::vector<Eigen::Vector3d>> nets;
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    nets.push_back(points_of(crystallize(torus, options).mesh));
  }
  EXPECT_EQ(nets[0], nets[1]);
}

TEST(CrystallizeNet, DoesNotDependOnTheUnitOfLength) {
  TriMesh capsule = make_shape("capsule", {}, 0.2);
  CrystalOptions options = quick(0.2);
  options.rest = NetRest::in_space;
  const RemeshResult small = crystallize(capsule, options);
  constexpr double factor = 1024.0;  // exact
  scale(capsule, factor);
  options.target_edge_length *= factor;
  const RemeshResult large = crystallize(capsule, options);
  EXPECT_EQ(triangles_of(small.mesh), triangles_of(large.mesh));
}

TEST(CrystallizeNet, DependsOnTheSeed) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  CrystalOptions other = quick(0.15);
  other.seed = 1;
  EXPECT_NE(points_of(crystallize(torus, quick(0.15)).mesh),
            points_of(crystallize(torus, other).mesh));
}

TEST(CrystallizeNet, KeepsTheBoundaryOfAnOpenSurface) {
  const TriMesh sheet = make_shape("wavy-sheet", {}, 0.1);
  const TriMesh net = crystallize(sheet, quick(0.12)).mesh;
  EXPECT_EQ(measure_quality(net).boundary_loops, 1);
  const auto distance = measure_distance(net, sheet);
  EXPECT_LT(distance.max(), 0.12 / 4.0);
}

TEST(CrystallizeNet, LeavesTheEndsOfTubesOpen) {
  const TriMesh tube = make_shape("open-tube", {{"radius", 1.0}, {"length", 4.0}}, 0.15);
  CrystalOptions options = quick(0.25);
  options.rest = NetRest::in_space;
  const RemeshResult result = crystallize(tube, options);
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_EQ(quality.boundary_loops, 2);
  const auto edges =
      std::ranges::count_if(result.mesh.edges(), [](const auto e) { return e.is_boundary(); });
  // Two zigzag edges have 2 · 2π / 0.25 edges, two armchair edges 2/√3 as many.
  EXPECT_GT(edges, 46);
  EXPECT_LT(edges, 62);
}

TEST(CrystallizeNet, KeepsCreases) {
  const TriMesh can = make_shape("tube", {}, 0.1);
  CrystalOptions options = quick(0.12);
  options.feature_angle = std::numbers::pi / 4.0;
  const TriMesh net = crystallize(can, options).mesh;
  // With its rims kept, chords are all that parts the net from the tube.
  EXPECT_LT(measure_distance(net, can).max(), 0.12 / 10.0);
  EXPECT_EQ(euler_characteristic(net), euler_characteristic(can));
}

TEST(CrystallizeNet, KeepsCreasesThatInflatingBlunts) {
  // Blades a third of a coarse edge thick.
  const TriMesh rotor = read_mesh(TRIVALENT_MESHES "/rotor.off").mesh;
  const double target = std::sqrt(surface_area(rotor) / 2500.0);
  CrystalOptions options = quick(target);
  options.feature_angle = std::numbers::pi / 3.0;
  const TriMesh net = crystallize(rotor, options).mesh;
  EXPECT_TRUE(testing_support::is_closed(net));
  EXPECT_LT(measure_distance(rotor, net).max(), target);
}

TEST(CrystallizeNet, CoversSolidsOfAFewLargeAcuteFaces) {
  const TriMesh tetrahedron = testing_support::tetrahedron();
  const double target = std::sqrt(8.0) / 20.0;
  const TriMesh net = crystallize(tetrahedron, quick(target)).mesh;
  const MeshQuality quality = measure_quality(net);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_GT(quality.regular_fraction, 0.85);
  EXPECT_LT(measure_distance(tetrahedron, net).max(), 2.0 * target);  // tips are rounded
}

TEST(CrystallizeNet, ComesOutOfASurfaceTooSmallForACoarseOne) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  const TriMesh net = crystallize(sphere, quick(0.9)).mesh;
  EXPECT_TRUE(testing_support::is_closed(net));
  EXPECT_GE(net.n_vertices(), 12U);
}

TEST(CrystallizeNet, IsWholeWhenStoppedEarly) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  for (const NetRest rest : {NetRest::on_surface, NetRest::in_space}) {
    CrystalOptions options = quick(0.15);
    options.rest = rest;
    for (const int last_question : {60, 75, 90, 150, 300}) {
      int questions = 0;
      options.should_stop = [&] { return ++questions == last_question; };
      const RemeshResult result = crystallize(torus, options);
      EXPECT_TRUE(result.stopped);
      EXPECT_TRUE(testing_support::is_closed(result.mesh));
      EXPECT_NEAR(mean_edge_length(result.mesh), 0.15, 0.05 * 0.15);
    }
  }
}

TEST(CrystallizeNet, ThrowsWhenStoppedBeforeItIsThere) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  CrystalOptions options = quick(0.15);
  options.should_stop = [] { return true; };
  EXPECT_THROW(static_cast<void>(crystallize(torus, options)), Stopped);
}

TEST(CrystallizeNet, ReportsProgressToTheEnd) {
  const TriMesh torus = make_shape("torus", {}, 0.16);
  CrystalOptions options = quick(0.15);
  RemeshProgress last;
  options.on_progress = [&](const RemeshProgress& progress) {
    EXPECT_GT(progress.iteration, last.iteration);
    EXPECT_GT(progress.strain, 0.0);
    last = progress;
  };
  const RemeshResult result = crystallize(torus, options);
  EXPECT_EQ(last.iteration, last.iterations);
  EXPECT_EQ(last.iteration, result.iterations);
  EXPECT_EQ(last.vertices, static_cast<int>(result.mesh.n_vertices()));
}

TEST(CrystallizeNet, RefusesWhatRemeshRefuses) {
  const TriMesh torus = make_shape("torus", {}, 0.3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double target : {0.0, -1.0, nan, 100.0, 1e-9}) {
    EXPECT_THROW(static_cast<void>(crystallize(torus, quick(target))), InvalidOption) << target;
  }
  EXPECT_THROW(static_cast<void>(crystallize(TriMesh(), quick(0.1))), InvalidMesh);
}

TEST(AnnealingWork, GrowsWithEffortAndSize) {
  for (const double vertices : {32.0, 300.0, 2000.0, 10000.0, 100000.0}) {
    const double normal = annealing_work(vertices, Effort::normal);
    EXPECT_LT(annealing_work(vertices, Effort::quick), normal);
    EXPECT_NEAR(annealing_work(vertices, Effort::thorough), 4.0 * normal, 0.01 * normal);
    // The last 20 rounds are at the target length.
    EXPECT_GT(normal, 20.0 * vertices);
  }
  EXPECT_LT(annealing_work(1e6, Effort::normal), 400.0 * 1e6);
}

TEST(Crystallize, HoldsANetAsStiffAsAsked) {
  // An ellipsoid, on which a free net buckles.
  const TriMesh mesh = make_shape("ellipsoid", {{"a", 20.0}, {"b", 14.0}, {"c", 9.0}}, 1.0);
  const auto distance = [&](double stiffness) {
    const CrystalOptions options = {.target_edge_length = 2.46,
                                    .effort = Effort::quick,
                                    .stiffness = stiffness,
                                    .rest = NetRest::in_space};
    return measure_distance(crystallize(mesh, options).mesh, mesh, 5000).root_mean_square();
  };
  EXPECT_LT(distance(2.0), 0.5 * distance(0.002));
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(static_cast<void>(distance(wrong)), InvalidOption);
  }
}

}  // namespace
}  // namespace trivalent::remesh
