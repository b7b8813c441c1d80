#include "crystal/net_patch.h"

#include <gtest/gtest.h>

#include <set>

#include "crystal/spring_relaxation.h"
#include "crystal/spring_step.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

/// A sheet whose patches are cut out in its middle.
class Patch : public testing::Test {
 protected:
  Patch() : mesh_(make_shape("sphere", {}, 0.2)), sphere_(mesh_) {}

  NetPatch cut_out(int vertex) {
    return {sphere_, motion_frames(sphere_), VertexHandle(vertex), 3, marks_};
  }

  /// Neighbors of a vertex of the patch, as a set.
  static std::set<int> ring(const NetPatch& patch, int v) {
    std::set<int> neighbors;
    for (int k = 0; k < patch.topology().valence(v); ++k)
      neighbors.insert(patch.topology().neighbor(v, k));
    return neighbors;
  }

  /// Every vertex inside is a neighbor of its neighbors inside, once.
  static void expect_manifold(const NetPatch& patch) {
    for (int v = 0; v < patch.topology().size(); ++v) {
      EXPECT_EQ(ring(patch, v).size(), static_cast<std::size_t>(patch.topology().valence(v)));
      for (const int w : ring(patch, v)) {
        if (patch.topology().valence(w) == 0) continue;
        EXPECT_EQ(ring(patch, w).count(v), 1U) << v << ' ' << w;
      }
    }
  }

  TriMesh mesh_;
  ConstrainedMesh sphere_;
  PatchMarks marks_;
};

TEST_F(Patch, IsTheMeshAroundItsCenter) {
  const NetPatch patch = cut_out(17);
  ASSERT_TRUE(patch.is_whole());
  EXPECT_EQ(patch.topology().vertex(0), VertexHandle(17));
  EXPECT_EQ(patch.topology().valence(0), static_cast<int>(mesh_.valence(VertexHandle(17))));
  for (int v = 0; v < patch.topology().size(); ++v) {
    if (v == patch.topology().added()) continue;  // free
    EXPECT_LT((patch.position(v) - mesh_.point(patch.topology().vertex(v))).norm(), 1e-6);
  }
  expect_manifold(patch);
}

TEST_F(Patch, TakesTheSpringStepOfTheWholeNet) {
  for (const double length : {0.15, 0.2, 0.25}) {  // pressed, at rest and stretched
    for (const int center : {0, 17, 100}) {
      const VertexHandle v(center);
      const MotionFrame frame = motion_frames(sphere_)[index(v)];
      SpringStep step(frame);
      for (const auto neighbor : mesh_.vv_range(v)) {
        step.add_edge(mesh_.point(neighbor) - mesh_.point(v), length);
      }
      NetPatch patch = cut_out(center);
      patch.relax(length, 1, 1);
      const Eigen::Vector3d moved = patch.position(0) - mesh_.point(v);
      // Single precision, amplified where the springs nearly cancel.
      EXPECT_LT((moved - step.displacement(length)).norm(), 1e-5 * length) << center;
    }
  }
}

TEST_F(Patch, FlipTakesAnEdgeAndGivesOne) {
  const NetPatch before = cut_out(17);
  const int a = before.topology().neighbor(0, 0);
  const int left = before.topology().neighbor(0, 1);
  const int right = before.topology().neighbor(0, before.topology().valence(0) - 1);
  NetPatch after = before;
  ASSERT_TRUE(after.flip(0, a));
  expect_manifold(after);
  EXPECT_EQ(after.topology().valence(0), before.topology().valence(0) - 1);
  EXPECT_EQ(after.topology().valence(left), before.topology().valence(left) + 1);
  EXPECT_EQ(ring(after, left).count(right), 1U);
  ASSERT_TRUE(after.flip(left, right));
  EXPECT_EQ(ring(after, 0), ring(before, 0));
}

TEST_F(Patch, CollapseUndoesSplit) {
  const NetPatch before = cut_out(17);
  const int a = before.topology().neighbor(0, 2);
  NetPatch after = before;
  ASSERT_TRUE(after.split(0, a));
  expect_manifold(after);
  const int added = after.topology().added();
  EXPECT_FALSE(after.topology().vertex(added).is_valid());
  EXPECT_EQ(after.topology().valence(added), 4);
  ASSERT_TRUE(after.collapse(added, a));
  expect_manifold(after);
  EXPECT_EQ(ring(after, 0), ring(before, 0));
  EXPECT_EQ(ring(after, a), ring(before, a));
}

TEST_F(Patch, MendingLowersTheDisorder) {
  NetPatch patch = cut_out(17);
  ASSERT_TRUE(patch.split(0, patch.topology().neighbor(0, 0)));
  const int before = patch.topology().disorder();
  patch.mend_valences();
  EXPECT_LT(patch.topology().disorder(), before);
  expect_manifold(patch);
}

TEST_F(Patch, RelaxingLowersTheStrainAndKeepsTheRim) {
  const double length = mean_edge_length(mesh_);
  const NetPatch before = cut_out(17);
  NetPatch after = before;
  after.relax(length, 8);
  EXPECT_LT(after.strain(length), before.strain(length));
  EXPECT_EQ(after.steep_corners(), 0);
  for (int v = 0; v < after.topology().size(); ++v) {
    if (after.is_free(v)) continue;
    EXPECT_EQ(after.position(v), before.position(v));
  }
}

TEST_F(Patch, RefusesChangesBeyondItsRim) {
  NetPatch patch = cut_out(17);
  const int rim = patch.topology().size() - 1;
  ASSERT_EQ(patch.topology().valence(rim), 0);
  EXPECT_FALSE(patch.flip(rim, 0));
  EXPECT_FALSE(patch.split(rim, 0));
  EXPECT_FALSE(patch.collapse(rim, 0));
  EXPECT_TRUE(patch.topology().changes().empty());
}

TEST(RelaxSprings, LowersTheStrainOnTheSurface) {
  TriMesh mesh = make_shape("ellipsoid", {}, 0.2);
  ConstrainedMesh constrained(mesh);
  const double length = mean_edge_length(mesh);
  const double before = spring_strain(mesh, length);
  relax_springs(constrained, length, 50);
  EXPECT_LT(spring_strain(mesh, length), before);
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d foot = constrained.surface().nearest(mesh.point(v)).position;
    EXPECT_LT((foot - mesh.point(v)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace trivalent::remesh
