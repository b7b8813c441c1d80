#include "trivalent/dual/dual_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "small_meshes.h"
#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

using testing_support::flat_sheet;
using testing_support::icosahedron;

TEST(ScaleForSize, GivesTheMeanBond) {
  remesh::TriMesh mesh = icosahedron();
  remesh::scale(mesh, scale_for_size(mesh, MeanBond{1.45}));
  EXPECT_NEAR(mean_bond_length(build_dual(mesh)), 1.45, 1e-14);
}

TEST(ScaleForSize, GivesTheLongestSide) {
  remesh::TriMesh mesh = flat_sheet(5, 2, 1.0);
  remesh::scale(mesh, scale_for_size(mesh, LongestSide{30.0}));
  EXPECT_NEAR(remesh::bounding_box(mesh).longest_side(), 30.0, 1e-13);
}

TEST(ScaleForSize, PassesAScaleOn) { EXPECT_EQ(scale_for_size(icosahedron(), Scale{2.5}), 2.5); }

TEST(ScaleForSize, ThrowsOnSizesOutOfRange) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, -1.0, std::nan(""), infinity}) {
    EXPECT_THROW(static_cast<void>(scale_for_size(icosahedron(), MeanBond{value})), InvalidOption);
    EXPECT_THROW(static_cast<void>(scale_for_size(icosahedron(), LongestSide{value})),
                 InvalidOption);
    EXPECT_THROW(static_cast<void>(scale_for_size(icosahedron(), Scale{value})), InvalidOption);
  }
}

TEST(ScaleForSize, ThrowsOnMeshesWithoutFacesBondsOrExtent) {
  EXPECT_THROW(static_cast<void>(scale_for_size(remesh::TriMesh(), Scale{1.0})), InvalidNetwork);
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const testing_support::Triangles one = {{0, 1, 2}};
  const remesh::TriMesh triangle = remesh::make_mesh(corners, one);
  EXPECT_THROW(static_cast<void>(scale_for_size(triangle, MeanBond{1.42})), InvalidNetwork);
  const std::vector<Eigen::Vector3d> point(3, Eigen::Vector3d::Zero());
  const remesh::TriMesh flat = remesh::make_mesh(point, one);
  EXPECT_THROW(static_cast<void>(scale_for_size(flat, LongestSide{1.0})), InvalidNetwork);
}

}  // namespace
}  // namespace trivalent::dual
