#include "mesh/point_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace trivalent::remesh {
namespace {

/// Vertices at random places of a cube around the origin.
TriMesh scattered(int count, double half) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-half, half);
  TriMesh mesh;
  for (int i = 0; i < count; ++i) {
    mesh.add_vertex({coordinate(random), coordinate(random), coordinate(random)});
  }
  return mesh;
}

TEST(PointGrid, FindsThePairsThatBruteForceFinds) {
  const TriMesh mesh = scattered(2000, 20.0);
  constexpr double cell = 2.5;
  const PointGrid grid(mesh, cell, 6.0);
  for (const double radius : {1.0, cell, 6.0}) {
    for (int i = 0; i < 2000; i += 13) {
      const Eigen::Vector3d& center = mesh.point(VertexHandle(i));
      std::multiset<int> found;
      grid.visit(center, radius, [&](int j, const Eigen::Vector3d& separation) {
        EXPECT_EQ(separation, mesh.point(VertexHandle(j)) - center);
        found.insert(j);
      });
      std::multiset<int> expected;
      for (const auto v : mesh.vertices()) {
        if ((mesh.point(v) - center).norm() <= radius) expected.insert(v.idx());
      }
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(PointGrid, FindsAllImagesInALattice) {
  TriMesh mesh = scattered(300, 20.0);
  Lattice::Cell cell;
  cell << 9.0, -3.0, 0.0,  //
      0.0, 8.0, 0.0,       //
      0.0, 1.0, 30.0;
  mesh.lattice = Lattice(cell, {true, true, false});
  const double radius = 5.0;
  const PointGrid grid(mesh, 2.0, radius);
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d& center = mesh.point(v);
    std::multiset<int> found;
    grid.visit(center, radius, [&](int j, const Eigen::Vector3d& separation) {
      EXPECT_LE(separation.norm(), radius);
      const Eigen::Vector3d translation = center + separation - mesh.point(VertexHandle(j));
      const Eigen::Vector3d whole = mesh.lattice.translation(mesh.lattice.image_of(translation));
      EXPECT_LT((translation - whole).norm(), 1e-9);
      found.insert(j);
    });
    std::multiset<int> expected;
    for (const auto w : mesh.vertices()) {
      for (int a = -12; a <= 12; ++a) {
        for (int b = -12; b <= 12; ++b) {
          const Eigen::Vector3d image = mesh.point(w) + mesh.lattice.translation({a, b, 0});
          if ((image - center).norm() <= radius) expected.insert(w.idx());
        }
      }
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace trivalent::remesh
