#include "crystal/net_patch.h"

#include <gtest/gtest.h>

#include <set>

#include "crystal/defect_moves.h"
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

/// Patches around the vertices of an open edge.
class BoundaryPatch : public testing::Test {
 protected:
  BoundaryPatch() : mesh_(make_shape("wavy-sheet", {}, 0.2)), sheet_(mesh_) {}

  PatchTopology cut_out(VertexHandle center) {
    return {sheet_, center, {.inner = 3, .known = 3}, marks_};
  }

  /// A vertex in the middle of a side, and the number in its patch of a neighbor on that side.
  [[nodiscard]] VertexHandle on_side() const {
    for (const auto v : mesh_.vertices()) {
      if (v.is_boundary() && sheet_.anchor(v).kind == FeatureKind::curve && v.valence() == 4) {
        return v;
      }
    }
    return VertexHandle();
  }
  static int first_along(const PatchTopology& patch) { return patch.neighbor(0, 0); }
  static int last_along(const PatchTopology& patch) {
    return patch.neighbor(0, patch.valence(0) - 1);
  }

  /// Whether the mesh has the neighbors of every inner vertex, in the same cyclic order.
  void expect_same(const PatchTopology& patch, const std::vector<VertexHandle>& vertices) const {
    for (int v = 0; v < patch.inner_count(); ++v) {
      if (!patch.is_inside(v)) continue;
      const VertexHandle center = vertices[index(v)];
      EXPECT_EQ(mesh_.valence(center), static_cast<unsigned>(patch.valence(v)));
      EXPECT_EQ(mesh_.is_boundary(center), patch.is_open(v));
      for (int k = 0; k < patch.valence(v); ++k) {
        const HalfedgeHandle h = mesh_.find_halfedge(center, vertices[index(patch.neighbor(v, k))]);
        ASSERT_TRUE(h.is_valid());
        const int next = patch.next_in_ring(v, patch.neighbor(v, k));
        EXPECT_EQ(mesh_.is_boundary(h), next < 0);
        if (next < 0) continue;
        EXPECT_EQ(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)), vertices[index(next)]);
      }
    }
  }

  TriMesh mesh_;
  ConstrainedMesh sheet_;
  PatchMarks marks_;
};

TEST_F(BoundaryPatch, SplitsAnEdgeOfTheBoundaryInTwo) {
  const std::size_t faces = mesh_.n_faces();
  for (const bool first : {true, false}) {
    PatchTopology patch = cut_out(on_side());
    ASSERT_TRUE(patch.is_whole());
    ASSERT_TRUE(patch.split(0, first ? first_along(patch) : last_along(patch)));
    EXPECT_EQ(patch.added_faces(), 1);
    const int added = patch.added();
    EXPECT_EQ(patch.valence(added), 3);
    EXPECT_TRUE(patch.is_open(added));
    EXPECT_EQ(patch.deviation(added), -1);
    const std::vector<VertexHandle> vertices = change_connectivity(sheet_, patch);
    expect_same(patch, vertices);
    for (const auto e : mesh_.ve_range(vertices[index(added)])) {
      EXPECT_EQ(e.is_boundary(), sheet_.curve_of(e).has_value());
    }
    Anchor anchor;
    anchor.kind = FeatureKind::curve;
    sheet_.set_anchor(vertices[index(added)], anchor);
  }
  EXPECT_EQ(mesh_.n_faces(), faces + 2);
}

TEST_F(BoundaryPatch, CollapsesAnEdgeOfTheBoundary) {
  for (const bool first : {true, false}) {
    mesh_.garbage_collection();
    PatchTopology patch = cut_out(on_side());
    ASSERT_TRUE(patch.collapse(0, first ? first_along(patch) : last_along(patch)));
    EXPECT_EQ(patch.added_faces(), -1);
    EXPECT_FALSE(patch.is_inside(0));
    const std::vector<VertexHandle> vertices = change_connectivity(sheet_, patch);
    expect_same(patch, vertices);
  }
  mesh_.garbage_collection();
  for (const auto e : mesh_.edges()) EXPECT_EQ(e.is_boundary(), sheet_.curve_of(e).has_value());
}

TEST_F(BoundaryPatch, CollapseUndoesSplit) {
  const PatchTopology before = cut_out(on_side());
  for (const bool first : {true, false}) {
    PatchTopology after = before;
    const int along = first ? first_along(before) : last_along(before);
    ASSERT_TRUE(after.split(0, along));
    ASSERT_TRUE(after.collapse(after.added(), along));
    EXPECT_EQ(after.added_faces(), 0);
    for (int v = 0; v < before.added(); ++v) {
      ASSERT_EQ(after.valence(v), before.valence(v));
      for (int k = 0; k < before.valence(v); ++k) {
        EXPECT_EQ(after.neighbor(v, k), before.neighbor(v, k));
      }
    }
  }
}

TEST_F(BoundaryPatch, KeepsCornersAndLeanVertices) {
  for (const auto v : mesh_.vertices()) {
    if (!v.is_boundary()) continue;
    PatchTopology patch = cut_out(v);
    const bool can_go = sheet_.anchor(v).kind != FeatureKind::corner && v.valence() > 2;
    EXPECT_EQ(patch.collapse(0, first_along(patch)), can_go) << v.idx();
    // An edge inwards takes no vertex of the boundary away.
    PatchTopology other = cut_out(v);
    if (v.valence() == 2) continue;
    EXPECT_FALSE(other.collapse(0, other.neighbor(0, 1))) << v.idx();
  }
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
