#include "trivalent/remesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "trivalent/remesh/error.h"

namespace trivalent::remesh {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

const std::vector<Eigen::Vector3d> unit_corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Triangles tetrahedron_faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(MakeMesh, BuildsATetrahedron) {
  const TriMesh mesh = make_mesh(unit_corners, tetrahedron_faces);
  EXPECT_EQ(mesh.n_vertices(), 4u);
  EXPECT_EQ(mesh.n_edges(), 6u);
  EXPECT_EQ(triangles_of(mesh).size(), tetrahedron_faces.size());
  EXPECT_NEAR(surface_area(mesh), 1.5 + std::sqrt(3.0) / 2.0, 1e-15);
  EXPECT_NEAR(mean_edge_length(mesh), (1.0 + std::sqrt(2.0)) / 2.0, 1e-15);
  EXPECT_EQ(bounding_box(mesh).low, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(bounding_box(mesh).high, Eigen::Vector3d(1, 1, 1));
}

TEST(MakeMesh, ThrowsOnACoordinateThatIsNotFinite) {
  auto points = unit_corners;
  points[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)make_mesh(points, tetrahedron_faces), InvalidMesh);
}

TEST(MakeMesh, ThrowsOnAnIndexOutOfRange) {
  EXPECT_THROW((void)make_mesh(unit_corners, Triangles{{0, 1, 4}}), InvalidMesh);
  EXPECT_THROW((void)make_mesh(unit_corners, Triangles{{0, 1, -1}}), InvalidMesh);
}

TEST(MakeMesh, ThrowsOnARepeatedCorner) {
  EXPECT_THROW((void)make_mesh(unit_corners, Triangles{{0, 1, 1}}), InvalidMesh);
}

TEST(MakeMesh, ThrowsOnAFlippedFace) {
  Triangles flipped = tetrahedron_faces;
  std::swap(flipped[1][0], flipped[1][1]);
  EXPECT_THROW((void)make_mesh(unit_corners, flipped), InvalidMesh);
}

TEST(MakeMesh, ThrowsOnThreeFacesAtAnEdge) {
  EXPECT_THROW((void)make_mesh(unit_corners, Triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 3}}),
               InvalidMesh);
}

TEST(MakeMesh, ThrowsOnTwoFansAtAVertex) {
  std::vector<Eigen::Vector3d> points = unit_corners;
  points.emplace_back(-1, 0, 0);
  points.emplace_back(0, -1, 0);
  EXPECT_THROW((void)make_mesh(points, Triangles{{0, 1, 2}, {0, 4, 5}}), InvalidMesh);
}

TEST(Scale, MultipliesEveryLength) {
  TriMesh mesh = make_mesh(unit_corners, tetrahedron_faces);
  const double before = mean_edge_length(mesh);
  scale(mesh, 1e-6);
  EXPECT_NEAR(mean_edge_length(mesh), 1e-6 * before, 1e-21);
}

}  // namespace
}  // namespace trivalent::remesh
