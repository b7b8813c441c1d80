#include "mesh/surface_projector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

TEST(SurfaceProjector, DropsAPerpendicularOntoAPlane) {
  const SurfaceProjector plane(testing_support::triangular_sheet(4, 4));
  const SurfacePoint foot = plane.nearest({2.3, 1.2, 0.7});
  EXPECT_LT((foot.position - Eigen::Vector3d(2.3, 1.2, 0.0)).norm(), 1e-15);
  EXPECT_LT((plane.normal(foot) - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(SurfaceProjector, FindsTheSamePointFromAnyFace) {
  const TriMesh torus = make_shape("torus", {}, 0.3);
  const SurfaceProjector surface(torus);
  const Eigen::Vector3d p(0.9, 0.5, 0.3);
  const SurfacePoint expected = surface.nearest(p);
  for (int face = 0; face < static_cast<int>(torus.n_faces()); ++face) {
    ASSERT_EQ(surface.nearest(p, face).position, expected.position) << "from face " << face;
  }
}

TEST(SurfaceProjector, WalksToTheNearestPointFromAnyFaceThatLooksThere) {
  const TriMesh sphere = make_shape("sphere", {}, 0.3);
  const SurfaceProjector surface(sphere);
  const Eigen::Vector3d p(0.9, 0.8, 0.7);
  const Eigen::Vector3d expected = surface.nearest(p).position;
  for (int face = 0; face < static_cast<int>(sphere.n_faces()); ++face) {
    if (sphere.calc_normal(FaceHandle(face)).dot(p) < 0.0) continue;
    ASSERT_LT((surface.walk_towards(p, face).position - expected).norm(), 1e-12) << face;
  }
}

TEST(SurfaceProjector, WalksOnTheSheetWhereItBegins) {
  TriMesh lens = make_shape("sphere", {}, 0.1);
  for (const auto v : lens.vertices()) lens.point(v).z() *= 0.05;
  const SurfaceProjector surface(lens);
  const int above = surface.nearest({0.1, 0.0, 1.0}).face;
  const Eigen::Vector3d p(0.0, 0.0, -0.02);
  EXPECT_LT(surface.nearest(p).position.z(), 0.0);
  EXPECT_GT(surface.walk_towards(p, above).position.z(), 0.0);
}

TEST(SurfaceProjector, InterpolatesTheNormalsOfASphere) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  const SurfaceProjector surface(sphere);
  for (const auto f : sphere.faces()) {
    const SurfacePoint center{sphere.calc_face_centroid(f), f.idx()};
    // Chords of length 0.1 on a unit sphere: the normals differ by an angle of order 0.1².
    ASSERT_LT((surface.normal(center) - center.position.normalized()).norm(), 0.01);
  }
}

TEST(SurfaceProjector, MeasuresTheThicknessStraightInwards) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  const SurfaceProjector surface(sphere);
  for (const auto v : sphere.vertices()) ASSERT_NEAR(surface.thickness(v), 2.0, 0.02);
}

TEST(SurfaceProjector, FindsAnOpenSheetInfinitelyThick) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
  const SurfaceProjector surface(make_mesh(points, triangles));
  EXPECT_TRUE(std::isinf(surface.thickness(VertexHandle(0))));
}

TEST(SurfaceProjector, SkipsFacesWithoutAnArea) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  const std::vector<std::array<int, 3>> triangles = {{0, 2, 3}, {0, 1, 2}};
  const SurfaceProjector surface(make_mesh(points, triangles));
  EXPECT_EQ(surface.nearest({1.0, -1.0, 0.0}).face, 0);
  EXPECT_EQ(surface.nearest({1.0, -1.0, 0.0}, 1).face, 0);
}

TEST(SurfaceProjector, ThrowsIfNoFaceHasAnArea) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
  EXPECT_THROW(SurfaceProjector(make_mesh(points, triangles)), InvalidMesh);
}

}  // namespace
}  // namespace trivalent::remesh
