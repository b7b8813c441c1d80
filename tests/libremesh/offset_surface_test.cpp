#include "trivalent/remesh/offset_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/remesh/surface_shape.h"

namespace trivalent::remesh {
namespace {

using std::numbers::pi;

TEST(OffsetSurface, OfASphereIsASphere) {
  const TriMesh sphere = make_shape("sphere", {{"radius", 10.0}}, 0.5);
  for (const double distance : {3.0, -3.0}) {
    const TriMesh offset = offset_surface(sphere, distance, 0.8);
    for (const auto v : offset.vertices()) {
      EXPECT_NEAR(offset.point(v).norm(), 10.0 + distance, 0.01);
    }
    const MeshComponents components = find_components(offset);
    ASSERT_EQ(components.parts.size(), 1U);
    EXPECT_EQ(components.parts[0].euler_characteristic(), 2);
    EXPECT_GT(components.parts[0].volume, 0.0);  // not turned inside out
  }
}

TEST(OffsetSurface, HasTheAreaThatSteinersFormulaSays) {
  const TriMesh torus = make_shape("torus", {{"R", 14.0}, {"r", 6.0}}, 0.5);
  EXPECT_NEAR(mean_curvature_integral(torus), 2.0 * pi * pi * 14.0, 0.5);
  const double distance = 2.0;
  const TriMesh offset = offset_surface(torus, distance, 0.8);
  const double area = surface_area(torus) + 2.0 * distance * mean_curvature_integral(torus);
  EXPECT_NEAR(surface_area(offset) / area, 1.0, 0.005);
}

TEST(OffsetSurface, GoesOnThroughTheFacesOfACell) {
  const TriMesh plane = make_shape("plane", {{"a", 12.0}, {"b", 9.0}, {"gamma", 70.0}}, 0.8);
  const TriMesh above = offset_surface(plane, 3.4, 0.8);
  const double z = plane.point(VertexHandle(0)).z();
  for (const auto v : above.vertices()) EXPECT_NEAR(above.point(v).z() - z, 3.4, 1e-6);
  EXPECT_NEAR(surface_area(above), surface_area(plane), 1e-6);
  EXPECT_EQ(above.lattice.cell(), plane.lattice.cell());

  const TriMesh tube = make_shape("periodic-tube", {{"radius", 5.0}, {"length", 9.0}}, 0.5);
  for (const double distance : {3.0, -2.0}) {
    const TriMesh offset = offset_surface(tube, distance, 0.6);
    for (const auto v : offset.vertices()) {
      EXPECT_NEAR(offset.point(v).head<2>().norm(), 5.0 + distance, 0.02);
    }
    EXPECT_EQ(find_components(offset).parts[0].euler_characteristic(), 0);
  }
  const TriMesh gyroid = make_shape("gyroid", {{"a", 30.0}}, 0.8);
  const TriMesh beside = offset_surface(gyroid, 2.0, 0.8);
  EXPECT_EQ(find_components(beside).parts[0].euler_characteristic(), -8);
}

TEST(OffsetSurface, MovesASurfaceWithItsBoundary) {
  const TriMesh tube = make_shape("open-tube", {{"radius", 5.0}, {"length", 20.0}}, 0.5);
  for (const double distance : {3.0, -2.0}) {
    const TriMesh offset = offset_surface(tube, distance, 0.5);
    for (const auto v : offset.vertices()) {
      EXPECT_NEAR(offset.point(v).head<2>().norm(), 5.0 + distance, 0.02);
    }
    EXPECT_FALSE(find_components(offset).parts[0].is_closed());
  }
  // Two walls at a right angle stay plane: the crease moves farther than they do.
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, 5, 0}, {4, 0, 0},
                                               {4, 5, 0}, {0, 0, 4}, {0, 5, 4}};
  const std::vector<std::array<int, 3>> faces = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {4, 1, 5}};
  const TriMesh beside = offset_surface(make_mesh(points, faces), 1.0, 1.0);
  EXPECT_NEAR((beside.point(VertexHandle(0)) - Eigen::Vector3d(1, 0, 1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((beside.point(VertexHandle(2)) - Eigen::Vector3d(4, 0, 1)).norm(), 0.0, 1e-9);
}

TEST(OffsetSurface, RefusesWhatCannotBe) {
  const TriMesh sphere = make_shape("sphere", {}, 0.1);
  EXPECT_THROW(static_cast<void>(offset_surface(sphere, -1.5, 0.1)), InvalidMesh);
  const TriMesh tube = make_shape("open-tube", {{"radius", 1.0}, {"length", 3.0}}, 0.2);
  EXPECT_THROW(static_cast<void>(offset_surface(tube, -1.5, 0.1)), InvalidMesh);
  // Two triangles that look at each other, 2 apart.
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0},
                                               {0, 0, 2}, {0, 3, 2}, {3, 0, 2}};
  const std::vector<std::array<int, 3>> faces = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_NO_THROW(static_cast<void>(offset_surface(make_mesh(points, faces), 0.9, 0.1)));
  EXPECT_THROW(static_cast<void>(offset_surface(make_mesh(points, faces), 1.5, 0.1)), InvalidMesh);
}

TEST(GaussCurvatureIntegral, IsTheSolidAngleOfTheNormals) {
  EXPECT_NEAR(gauss_curvature_integral(make_shape("sphere", {}, 0.1)), 4.0 * pi, 1e-9);
  EXPECT_NEAR(gauss_curvature_integral(make_shape("open-tube", {}, 0.2)), 0.0, 1e-9);
}

TEST(MeanCurvatureIntegral, OfASphereIsFourPiR) {
  const TriMesh sphere = make_shape("sphere", {{"radius", 3.0}}, 0.1);
  EXPECT_NEAR(mean_curvature_integral(sphere), 4.0 * pi * 3.0, 0.01);
}

}  // namespace
}  // namespace trivalent::remesh
