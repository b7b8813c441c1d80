#include "trivalent/shell/build_shell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "small_meshes.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::dual {
namespace {

using testing_support::torus;

/// Quick, and coarse enough to stay so.
remesh::RemeshOptions few_iterations() {
  remesh::RemeshOptions options;
  options.iterations = 10;
  return options;
}

TEST(BuildShell, MeetsANumberOfAtomsAndTheBond) {
  const Shell shell = build_shell(
      torus(48, 16), {.size = AtomCount{1000}, .bond = 1.45, .method = few_iterations()});
  const NetworkReport report = check_network(shell.structure);
  EXPECT_NEAR(report.atoms, 1000, 30);  // few iterations scatter by 1 % around the 2 % aimed at
  EXPECT_NEAR(report.bond_mean, 1.45, 1e-13);
  EXPECT_TRUE(report.is_trivalent());
  EXPECT_EQ(report.ring_excess, 0);
  EXPECT_EQ(static_cast<std::size_t>(report.atoms), shell.surface.mesh.n_faces());
}

TEST(BuildShell, TakesTheNearestOfSeveralAttemptsAtANumberOfAtoms) {
  // So few atoms that each attempt misses by much, and not the last by least.
  const remesh::TriMesh mesh = remesh::make_shape("sphere", {}, 0.1);
  const auto options = [](int atoms) {
    return ShellOptions{.size = AtomCount{atoms}, .method = few_iterations()};
  };
  for (const int atoms : {30, 36, 42, 60}) {
    const Shell shell = build_shell(mesh, options(atoms));
    double target = estimate_shell(mesh, options(atoms)).edge_length;
    double smallest_miss = 1.0;
    for (int attempt = 0; attempt < shell.remeshings; ++attempt) {
      const double faces =
          static_cast<double>(remesh::remesh_by(mesh, few_iterations(), target).mesh.n_faces());
      smallest_miss = std::min(smallest_miss, std::abs(faces / atoms - 1.0));
      target *= std::sqrt(faces / atoms);
    }
    const double miss = std::abs(static_cast<double>(shell.surface.mesh.n_faces()) / atoms - 1.0);
    EXPECT_EQ(miss, smallest_miss) << atoms;
  }
}

TEST(BuildShell, KeepsWhatItHasWhereACorrectionWouldBeTooLong) {
  // The first attempt has too many atoms; fewer need edges that a sphere cannot hold.
  const remesh::TriMesh sphere = remesh::make_shape("sphere", {}, 0.1);
  const Shell shell = build_shell(sphere, {.size = AtomCount{24}, .method = few_iterations()});
  EXPECT_EQ(shell.remeshings, 1);
  EXPECT_GT(shell.surface.mesh.n_faces(), 24U);
}

TEST(BuildShell, MeetsAScaleWithEdgesNearTheTarget) {
  const Shell shell =
      build_shell(torus(48, 16), {.size = Scale{6.0}, .bond = 1.42, .method = few_iterations()});
  EXPECT_EQ(shell.scale, 6.0);
  EXPECT_NEAR(remesh::mean_edge_length(shell.surface.mesh), edge_length_for_bond(1.42),
              0.03 * edge_length_for_bond(1.42));
}

TEST(BuildShell, MeetsTheLongestSide) {
  const remesh::TriMesh mesh = torus(48, 16);
  const Shell shell =
      build_shell(mesh, {.size = LongestSide{45.0}, .bond = 1.42, .method = few_iterations()});
  EXPECT_NEAR(shell.scale * remesh::bounding_box(mesh).longest_side(), 45.0, 1e-12);
}

TEST(BuildShell, ThrowsOnSizesOutOfRange) {
  const remesh::TriMesh mesh = torus(12, 6);
  for (const ShellSize& size : {ShellSize(AtomCount{19}), ShellSize(LongestSide{0.0}),
                                ShellSize(LongestSide{std::nan("")}), ShellSize(Scale{-1.0})}) {
    EXPECT_THROW(static_cast<void>(build_shell(mesh, {.size = size, .method = {}})), InvalidOption);
  }
  EXPECT_THROW(static_cast<void>(build_shell(mesh, {.bond = 0.0, .method = {}})), InvalidOption);
}

TEST(BuildShell, ThrowsOnAMeshWithoutFaces) {
  EXPECT_THROW(static_cast<void>(build_shell(remesh::TriMesh(), {.method = {}})), InvalidNetwork);
}

TEST(BuildShell, PassesOnWhatRemeshRefuses) {
  ShellOptions options;
  options.method = remesh::RemeshOptions{.rings = 0};
  EXPECT_THROW(static_cast<void>(build_shell(torus(12, 6), options)), remesh::InvalidOption);
}

TEST(EstimateShell, DividesTheAreaByThatOfAFace) {
  const remesh::TriMesh sheet = testing_support::flat_sheet(10, 10, 1.0);
  const double scale = edge_length_for_bond(1.42);
  const ShellEstimate scaled = estimate_shell(sheet, {.size = Scale{scale}, .method = {}});
  EXPECT_NEAR(scaled.atoms, 200.0, 1e-9);
  EXPECT_NEAR(scaled.edge_length, 1.0, 1e-12);
  const ShellEstimate counted = estimate_shell(sheet, {.size = AtomCount{50}, .method = {}});
  EXPECT_EQ(counted.atoms, 50.0);
  EXPECT_NEAR(counted.edge_length, 2.0, 1e-12);
  EXPECT_NEAR(counted.scale, 0.5 * scale, 1e-12);
}

TEST(EstimateShell, ThrowsOnAMeshWithoutAnArea) {
  remesh::TriMesh sheet = testing_support::flat_sheet(2, 2, 1.0);
  remesh::scale(sheet, 0.0);
  EXPECT_THROW(static_cast<void>(estimate_shell(sheet, {.method = {}})), InvalidNetwork);
}

TEST(BuildShell, ReportsProgressThatNeverGoesBack) {
  std::vector<remesh::RemeshProgress> states;
  remesh::RemeshOptions method;
  method.iterations = 5;
  method.on_progress = [&](const remesh::RemeshProgress& state) { states.push_back(state); };
  const Shell shell = build_shell(remesh::make_shape("sphere", {}, 0.2),
                                  {.size = AtomCount{500}, .method = method});
  ASSERT_GE(states.size(), 5u);
  for (std::size_t i = 1; i < states.size(); ++i) {
    EXPECT_GE(states[i].iteration, states[i - 1].iteration);
    EXPECT_LE(states[i].iteration, states[i].iterations);
  }
  EXPECT_EQ(states.back().iteration, states.back().iterations);
  EXPECT_EQ(states.back().iteration, 5 * shell.remeshings);
}

}  // namespace
}  // namespace trivalent::dual
