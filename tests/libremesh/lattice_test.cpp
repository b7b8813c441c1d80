#include "trivalent/remesh/lattice.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "trivalent/remesh/error.h"

namespace trivalent::remesh {
namespace {

Lattice::Cell oblique() {
  Lattice::Cell cell;
  cell << 10.0, 9.0, -17.0,  //
      0.0, 7.0, 6.0,         //
      0.0, 0.0, 5.0;
  return cell;
}

const std::vector<Lattice> lattices() {
  const Lattice::Cell box = Eigen::Vector3d(4.0, 5.0, 6.0).asDiagonal();
  return {Lattice(box, {true, true, true}), Lattice(box, {false, true, false}),
          Lattice(oblique(), {true, true, true}), Lattice(oblique(), {true, false, true}),
          Lattice(oblique(), {false, false, true})};
}

std::vector<Eigen::Vector3d> scattered(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  }
  return points;
}

/// The length of the shortest image, by trying many.
double shortest_image(const Lattice& lattice, const Eigen::Vector3d& d) {
  constexpr int most = 14;
  const auto range = [&](std::size_t k) { return lattice.periodic()[k] ? most : 0; };
  double shortest = std::numeric_limits<double>::infinity();
  for (int a = -range(0); a <= range(0); ++a) {
    for (int b = -range(1); b <= range(1); ++b) {
      for (int c = -range(2); c <= range(2); ++c) {
        shortest = std::min(shortest, (d + lattice.translation({a, b, c})).norm());
      }
    }
  }
  return shortest;
}

TEST(Lattice, OfAFreeSurfaceChangesNothing) {
  const Lattice free;
  EXPECT_FALSE(free.is_periodic());
  const Eigen::Vector3d d(1e9, -2.0, 0.1);
  EXPECT_EQ(free.nearest(d), d);
  EXPECT_EQ(free.near({1.0, 2.0, 3.0}, d), d);
  EXPECT_EQ(free.wrapped(d), d);
  EXPECT_TRUE(free.is_nearest(d));
  EXPECT_EQ(free.image_of(d), (Lattice::Image{0, 0, 0}));
}

TEST(Lattice, NearestImagesAreThoseThatBruteForceFinds) {
  for (const Lattice& lattice : lattices()) {
    for (const Eigen::Vector3d& d : scattered(300)) {
      const Eigen::Vector3d nearest = lattice.nearest(d);
      EXPECT_NEAR(nearest.norm(), shortest_image(lattice, d), 1e-9);
      const Eigen::Vector3d translation = lattice.translation(lattice.image_of(nearest - d));
      EXPECT_LT((d + translation - nearest).norm(), 1e-9) << "differ by a translation";
      EXPECT_TRUE(lattice.is_nearest(nearest));
      EXPECT_LE(nearest.dot(nearest), d.dot(d) + 1e-9);
    }
  }
}

TEST(Lattice, NumbersBeyondAllBoundsEndTheSearch) {
  for (const Lattice& lattice : lattices()) {
    for (const double far : {1e30, 1e200, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
      static_cast<void>(lattice.nearest({far, -far, far}));
    }
  }
}

TEST(Lattice, ShortestTranslationIsNoImageOfZero) {
  EXPECT_DOUBLE_EQ(lattices()[0].shortest(), 4.0);
  EXPECT_DOUBLE_EQ(lattices()[1].shortest(), 5.0);
  // Of the oblique cell: b - a and c + 2a, shortened by it, give vectors shorter than any of it.
  const Lattice lattice = lattices()[2];
  double shortest = std::numeric_limits<double>::infinity();
  for (int a = -9; a <= 9; ++a) {
    for (int b = -9; b <= 9; ++b) {
      for (int c = -9; c <= 9; ++c) {
        if (a == 0 && b == 0 && c == 0) continue;
        shortest = std::min(shortest, lattice.translation({a, b, c}).norm());
      }
    }
  }
  EXPECT_NEAR(lattice.shortest(), shortest, 1e-12);
}

TEST(Lattice, WrappedPointsLieInTheCell) {
  const Lattice lattice(oblique(), {true, true, true});
  const Eigen::Matrix3d inverse = oblique().inverse();
  for (const Eigen::Vector3d& p : scattered(200)) {
    const Eigen::Vector3d wrapped = lattice.wrapped(p);
    const Eigen::Array3d fractions = inverse * wrapped;
    EXPECT_TRUE((fractions >= -1e-12).all() && (fractions < 1.0 + 1e-12).all());
    EXPECT_LT(lattice.nearest(wrapped - p).norm(), 1e-9);
  }
}

TEST(Lattice, TranslationsWithinReachLeadToEveryNearestImage) {
  for (const Lattice& lattice : lattices()) {
    const double radius = lattice.covering_radius();
    const auto translations = lattice.translations_within(radius);
    const auto points = scattered(60);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Eigen::Vector3d a = lattice.wrapped(points[i]);
      const Eigen::Vector3d b = lattice.wrapped(points[i - 1]);
      double nearest = (b - a).norm();
      for (const Eigen::Vector3d& t : translations) {
        nearest = std::min(nearest, (b - a - t).norm());
      }
      EXPECT_NEAR(nearest, lattice.nearest(b - a).norm(), 1e-9);
    }
  }
}

TEST(Lattice, RefusesVectorsThatSpanTooLittle) {
  Lattice::Cell cell = oblique();
  cell.col(2) = cell.col(0) - 3.0 * cell.col(1);
  EXPECT_THROW(Lattice(cell, {true, true, true}), InvalidOption);
  EXPECT_NO_THROW(Lattice(cell, {true, true, false}));
  cell.col(1).setZero();
  EXPECT_THROW(Lattice(cell, {true, true, false}), InvalidOption);
  const Lattice::Cell left_handed = -oblique();
  EXPECT_THROW(Lattice(left_handed, {true, true, true}), InvalidOption);
  cell.col(0).x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Lattice(cell, {true, false, false}), InvalidOption);
}

}  // namespace
}  // namespace trivalent::remesh
