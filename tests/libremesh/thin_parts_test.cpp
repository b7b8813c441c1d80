#include "crystal/thin_parts.h"

#include <gtest/gtest.h>

#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

class ThinParts : public testing::Test {
 protected:
  ThinParts() : mesh_(original_), net_(mesh_) { net_.stay_on_sheets(0.1 * length); }

  void move(int vertex, const Eigen::Vector3d& to) {
    Anchor anchor = net_.anchor(VertexHandle(vertex));
    mesh_.point(VertexHandle(vertex)) = net_.project(to, anchor);
    net_.set_anchor(VertexHandle(vertex), anchor);
  }

  [[nodiscard]] int faces_inside_out() const {
    int count = 0;
    for (const auto f : mesh_.faces()) {
      if (mesh_.calc_normal(f).dot(mesh_.calc_face_centroid(f)) < 0.0) ++count;
    }
    return count;
  }

  static constexpr double length = 0.2;
  const TriMesh original_ = make_shape("sphere", {}, length);
  TriMesh mesh_;
  ConstrainedMesh net_;
};

TEST_F(ThinParts, UnfoldsAVertexThatWasPulledOverItsNeighbors) {
  const VertexHandle v(50);
  const Eigen::Vector3d beyond = mesh_.point(*mesh_.vv_begin(v)) * 2.5 - mesh_.point(v) * 1.5;
  move(50, beyond);
  ASSERT_GT(faces_inside_out(), 0);
  unfold(net_);
  EXPECT_EQ(faces_inside_out(), 0);
}

TEST_F(ThinParts, LeavesASoundNetAlone) {
  const std::vector<std::array<int, 3>> faces = triangles_of(mesh_);
  unfold(net_);
  mend_thin_parts(net_, original_, length);
  part_sheets(net_);
  smooth_crossings(net_);
  EXPECT_EQ(triangles_of(mesh_), faces);
  for (const auto v : mesh_.vertices()) ASSERT_EQ(mesh_.point(v), original_.point(v));
}

TEST_F(ThinParts, SmoothsFacesThatCross) {
  const Eigen::Vector3d beyond =
      mesh_.point(*mesh_.vv_begin(VertexHandle(50))) * 2.5 - mesh_.point(VertexHandle(50)) * 1.5;
  mesh_.point(VertexHandle(50)) = beyond;
  ASSERT_GT(measure_quality(mesh_).self_intersections, 0);
  smooth_crossings(net_);
  EXPECT_EQ(measure_quality(mesh_).self_intersections, 0);
  // Far from there nothing moves.
  EXPECT_EQ(mesh_.point(VertexHandle(0)), original_.point(VertexHandle(0)));
}

TEST_F(ThinParts, SplitsWhatIsStretchedAndCollapsesWhatIsPressed) {
  for (int i = 0; i < 40; ++i) move(i, mesh_.point(VertexHandle(i)) + Eigen::Vector3d(0.3, 0, 0));
  unfold(net_);
  mend_thin_parts(net_, original_, length);
  const MeshQuality quality = measure_quality(mesh_);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_EQ(quality.euler_characteristic, 2);
  EXPECT_LT(quality.edge_length.max, 1.6 * length);
}

}  // namespace
}  // namespace trivalent::remesh
