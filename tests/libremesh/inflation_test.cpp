#include "crystal/inflation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

/// A sphere of radius 1, made 0.1 thick.
TriMesh lens() {
  TriMesh mesh = make_shape("sphere", {}, 0.1);
  for (const auto v : mesh.vertices()) mesh.point(v).z() *= 0.05;
  return mesh;
}

TEST(Inflation, LeavesThickSurfacesAlone) {
  TriMesh sphere = make_shape("sphere", {}, 0.2);
  EXPECT_FALSE(inflated(ConstrainedMesh(sphere), 1.5).has_value());
  EXPECT_TRUE(inflated(ConstrainedMesh(sphere), 2.5).has_value());
}

TEST(Inflation, BringsThinPartsToTheThickness) {
  const TriMesh thin = lens();
  TriMesh mesh = thin;
  const std::optional<TriMesh> thick = inflated(ConstrainedMesh(mesh), 0.5);
  ASSERT_TRUE(thick.has_value());
  for (const auto v : thin.vertices()) {
    const double before = std::abs(thin.point(v).z());
    const double after = std::abs(thick->point(v).z());
    EXPECT_GE(after, before - 1e-12);
    if (thin.point(v).head<2>().norm() < 0.5) {
      EXPECT_NEAR(after, 0.25, 0.01);
    }
  }
}

TEST(Inflation, LeavesBoundariesInPlace) {
  TriMesh open = lens();
  open.delete_face(FaceHandle(0));
  open.garbage_collection();
  const TriMesh before = open;
  const std::optional<TriMesh> thick = inflated(ConstrainedMesh(open), 0.5);
  ASSERT_TRUE(thick.has_value());
  int on_boundary = 0;
  for (const auto v : before.vertices()) {
    if (!v.is_boundary()) continue;
    ++on_boundary;
    EXPECT_EQ(thick->point(v), before.point(v));
  }
  EXPECT_EQ(on_boundary, 3);
}

TEST(Inflation, CarriesANetBackToTheSurface) {
  const TriMesh thin = lens();
  TriMesh mesh = thin;
  const TriMesh thick = inflated(ConstrainedMesh(mesh), 0.5).value();
  TriMesh net = thick;
  ConstrainedMesh on_thick(net);
  on_thick.subdivide();
  const ConstrainedMesh::State carried = carried_over(on_thick.state(), thick, thin);
  ASSERT_EQ(carried.positions.size(), net.n_vertices());
  EXPECT_LT(std::ranges::max(distances_to_surface(carried.positions, thin)), 1e-12);
  for (const auto v : thin.vertices()) {
    EXPECT_LT((carried.positions[index(v)] - thin.point(v)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace trivalent::remesh
