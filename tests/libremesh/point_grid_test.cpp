#include "crystal/point_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace trivalent::remesh {
namespace {

TEST(PointGrid, FindsThePairsThatBruteForceFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-20.0, 20.0);
  std::vector<Eigen::Vector3d> points;
  std::vector<int> chosen;
  for (int i = 0; i < 2000; ++i) {
    points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    if (i % 7 != 0) chosen.push_back(i);
  }
  constexpr double cell = 2.5;
  const PointGrid grid(points, chosen, cell);
  for (const double radius : {1.0, cell, 6.0}) {
    for (int i = 0; i < 2000; i += 13) {
      const Eigen::Vector3d& center = points[static_cast<std::size_t>(i)];
      std::multiset<int> found;
      grid.visit(center, radius, [&](int j, double) { found.insert(j); });
      std::multiset<int> expected;
      for (const int j : chosen) {
        if ((points[static_cast<std::size_t>(j)] - center).norm() <= radius) expected.insert(j);
      }
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace trivalent::remesh
