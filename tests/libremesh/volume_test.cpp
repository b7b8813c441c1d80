#include "trivalent/remesh/volume.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "sampled_volume.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {
namespace {

using std::numbers::pi;

Volume schwarz_p(int points, double edge) {
  const Field field = [](const Eigen::Vector3d& p) {
    return std::cos(p.x()) + std::cos(p.y()) + std::cos(p.z());
  };
  return sampled(field, {points, points, points}, Eigen::Vector3d::Zero(),
                 edge * Eigen::Matrix3d::Identity());
}

/// Distance from a sphere of radius 6 in the middle of a cube of 20 steps, negative inside.
Volume ball(double sign) {
  const Field field = [sign](const Eigen::Vector3d& p) {
    return sign * ((p - Eigen::Vector3d(30.0, 10.0, 10.0)).norm() - 6.0);
  };
  return sampled(field, {21, 21, 21}, {20.0, 0.0, 0.0}, Eigen::Matrix3d::Identity());
}

double enclosed_volume(const TriMesh& mesh) {
  double sum = 0.0;
  for (const auto f : mesh.faces()) {
    Eigen::Matrix3d corners;
    Eigen::Index k = 0;
    for (const auto v : f.vertices()) corners.col(k++) = mesh.point(v);
    sum += corners.determinant() / 6.0;
  }
  return sum;
}

TEST(Volume, IsExactAtItsPointsAndForLinesBetween) {
  const Volume volume = lopsided();
  const auto line = [](const Eigen::Vector3d& p) { return p.x() + 10.0 * p.y() - 3.0 * p.z(); };
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(1.0, -2.0, 0.5), Eigen::Vector3d(1.5, -1.75, 2.5),
        Eigen::Vector3d(1.5, -1.6, 4.0)}) {
    EXPECT_NEAR(volume.value_at(p, {false, false, false}), line(p), 1e-5);
  }
  // Beyond the border nothing changes, unless it repeats.
  EXPECT_NEAR(volume.value_at({5.0, -2.0, 0.5}, {false, false, false}), line({2.0, -2.0, 0.5}),
              1e-5);
  EXPECT_NEAR(volume.value_at({2.5, -2.0, 0.5}, {true, false, false}), line({1.0, -2.0, 0.5}),
              1e-5);
}

TEST(Volume, HasASlopeWithoutSteps) {
  const Volume volume = schwarz_p(16, 2.0 * pi / 16.0);
  const auto slope = [&](double x) {
    constexpr double h = 1e-5;
    const auto value = [&](double at) {
      return volume.value_at({at, 0.3, 0.4}, {true, true, true});
    };
    return (value(x + h) - value(x - h)) / (2.0 * h);
  };
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(slope(0.31 * i), -std::sin(0.31 * i), 0.02) << i;
}

TEST(VolumeLevelSet, IsTheSphereWhateverSideIsHigher) {
  for (const double sign : {1.0, -1.0}) {
    const TriMesh mesh = level_set(ball(sign), 0.0, {false, false, false}, 1.0);
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_NEAR(enclosed_volume(mesh), 4.0 / 3.0 * pi * 216.0, 20.0);  // outwards, so positive
    for (const auto v : mesh.vertices()) {
      EXPECT_NEAR((mesh.point(v) - Eigen::Vector3d(30.0, 10.0, 10.0)).norm(), 6.0, 0.01);
    }
  }
}

TEST(VolumeLevelSet, GoesOnInTheNextCell) {
  constexpr int points = 24;
  const double step = 2.0 * pi / points;
  const TriMesh mesh = level_set(schwarz_p(points, step), 0.0, {true, true, true}, 0.3);
  EXPECT_EQ(euler_characteristic(mesh), -4);
  EXPECT_NEAR(mesh.lattice.cell()(0, 0), 2.0 * pi, 1e-12);
  // The same with its first points once more at the end.
  const TriMesh repeated = level_set(schwarz_p(points + 1, step), 0.0, {true, true, true}, 0.3);
  EXPECT_NEAR(repeated.lattice.cell()(2, 2), 2.0 * pi, 1e-12);
  EXPECT_EQ(repeated.n_faces(), mesh.n_faces());
}

TEST(VolumeLevelSet, SaysWhereTheSurfaceLeaves) {
  const Volume volume = schwarz_p(24, 2.0 * pi / 24.0);
  EXPECT_THROW(static_cast<void>(level_set(volume, 0.0, {false, false, false}, 0.3)), InvalidMesh);
  EXPECT_THROW(static_cast<void>(level_set(volume, 0.0, {true, true, false}, 0.3)), InvalidMesh);
  EXPECT_THROW(static_cast<void>(level_set(volume, 5.0, {true, true, true}, 0.3)), InvalidMesh);
  EXPECT_THROW(static_cast<void>(level_set(lopsided(), -14.0, {false, false, false}, 1.0)),
               InvalidMesh);
}

}  // namespace
}  // namespace trivalent::remesh
