#include "crystal/membrane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "crystal/membrane_laplacian.h"
#include "crystal/membrane_minimizer.h"
#include "crystal/membrane_net.h"
#include "crystal/membrane_preconditioner.h"
#include "crystal/parallel_membrane.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

using LanePositions = std::vector<Lanes<double>>;

/// Points near each other, so that all terms act.
LanePositions scattered_lanes(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  LanePositions positions;
  for (int i = 0; i < count; ++i) {
    positions.emplace_back(coordinate(random), coordinate(random), coordinate(random), 0.0);
  }
  return positions;
}

void expect_gradient_of_energy(const MembraneTerms<double>& terms) {
  const Membrane membrane;
  const LanePositions x = scattered_lanes(6);
  LanePositions gradient(x.size(), Lanes<double>::Zero());
  const double energy = membrane_energy(membrane, terms, x, gradient);
  EXPECT_GT(energy, 0.0);
  constexpr double step = 1e-5;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      LanePositions ignored(x.size(), Lanes<double>::Zero());
      LanePositions moved = x;
      moved[i][k] += step;
      const double above = membrane_energy(membrane, terms, moved, ignored);
      moved[i][k] -= 2.0 * step;
      const double below = membrane_energy(membrane, terms, moved, ignored);
      // Central differences: the error is a third derivative times step²/6, and rounding.
      EXPECT_NEAR(gradient[i][k], (above - below) / (2.0 * step), 1e-6 * (1.0 + energy))
          << "vertex " << i << ", component " << k;
    }
  }
}

TEST(MembraneEnergy, GradientOfStretchingMatches) {
  expect_gradient_of_energy({.edges = {{0, 1}, {1, 2}, {2, 3}, {4, 5}}});
}

TEST(MembraneEnergy, GradientOfBendingMatches) {
  // Four at once, and two alone.
  expect_gradient_of_energy(
      {.hinges = {
           {0, 1, 2, 3}, {2, 3, 4, 5}, {1, 4, 0, 5}, {5, 0, 3, 1}, {3, 5, 1, 2}, {4, 2, 5, 0}}});
}

TEST(MembraneEnergy, GradientOfSelfAvoidanceMatches) {
  expect_gradient_of_energy({.contacts = {{0, 1}, {0, 2}, {1, 3}, {2, 4}, {3, 5}, {4, 5}}});
}

TEST(MembraneEnergy, GradientOfTethersMatches) {
  expect_gradient_of_energy(
      {.tethers = {{0, 0.3, {0.1, 0.2, 0.3, 0.0}, Lanes<double>(1.0, 2.0, -1.0, 0.0).normalized()},
                   {4, 0.7, {0.0, -0.5, 0.3, 0.0}, Lanes<double>(0.0, 0.0, 1.0, 0.0)}}});
}

TEST(ParallelMembrane, IsTheSumOfAllTermsWhateverTheParts) {
  // More hinges than a part has at least, and numbers of other terms that no number of parts
  // divides.
  constexpr int count = 9001;
  const Membrane membrane;
  LanePositions x;
  MembraneTerms<double> terms;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  for (int i = 0; i < count; ++i) {
    x.emplace_back(1.5 * i + noise(random), noise(random), noise(random), 0.0);
    if (i < 3) continue;
    terms.hinges.push_back({i - 2, i - 1, i - 3, i});
    terms.contacts.push_back({i - 1, i});
    if (i % 3 == 0) terms.tethers.push_back({i, 0.4, x[0], Lanes<double>(0.0, 0.0, 1.0, 0.0)});
    if (i % 7 == 0) terms.edges.push_back({i - 1, i});
    if (i % 11 == 0) terms.pulls.push_back({i, 0.2, x[0]});
  }
  LanePositions expected(count, Lanes<double>::Zero());
  const double energy = membrane_energy(membrane, terms, x, expected);
  LanePositions gradient(count, Lanes<double>::Constant(1.0));
  ParallelMembrane parallel(membrane, terms, count);
  EXPECT_NEAR(parallel.evaluate(x, gradient), energy, 1e-12 * energy);
  double largest = 0.0;
  for (const auto& slope : expected) largest = std::max(largest, slope.norm());
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_LT((gradient[i] - expected[i]).norm(), 1e-12 * largest) << i;
  }
}

TEST(MembraneEnergy, GradientOfPullsMatches) {
  expect_gradient_of_energy(
      {.pulls = {{1, 0.3, {14.0, 0.2, 0.3, 0.0}}, {4, 0.7, {0.0, -13.5, 0.3, 0.0}}}});
}

TEST(MembraneEnergy, VerticesApartDoNotRepel) {
  const Membrane membrane;
  const LanePositions x = {{0.0, 0.0, 0.0, 0.0},
                           {1.01 * membrane.contact_distance(), 0.0, 0.0, 0.0}};
  LanePositions gradient(2, Lanes<double>::Zero());
  const MembraneTerms<double> terms = {.contacts = {{0, 1}}};
  EXPECT_EQ(membrane_energy(membrane, terms, x, gradient), 0.0);
}

/// A cylinder rolled up from an equilateral lattice has the bending energy κ/(2R²) per area.
TEST(MembraneEnergy, BendingOfACylinderIsThatOfTheContinuum) {
  const Membrane membrane;
  const double length = membrane.length;
  const double radius = 40.0 * length;
  const double height = 0.5 * std::sqrt(3.0) * length;
  // Rows run along the axis; a vertex and what is around it.
  const auto at = [&](double row, double along) {
    const double angle = row * height / radius;
    return Lanes<double>(radius * std::cos(angle), radius * std::sin(angle), along * length, 0.0);
  };
  const LanePositions x = {at(0, 0),     at(0, 1),    at(1, 0.5), at(1, -0.5), at(0, -1),
                           at(-1, -0.5), at(-1, 0.5), at(1, 1.5), at(2, 0),    at(1, -1.5)};
  LanePositions gradient(x.size(), Lanes<double>::Zero());
  MembraneTerms<double> terms;
  terms.hinges = {{0, 1, 2, 6}, {0, 2, 3, 1}, {0, 3, 4, 2}};  // the three edges of a vertex
  double stretching = 0.0;
  for (const Hinge& h : terms.hinges) {
    const double stretch =
        (x[static_cast<std::size_t>(h.b)] - x[static_cast<std::size_t>(h.a)]).norm() - length;
    stretching += 0.5 * membrane.stretching * stretch * stretch;
  }
  const double bending = membrane_energy(membrane, terms, x, gradient) - stretching;
  const double expected = 0.5 * Membrane::bending / (radius * radius) * height * length;
  EXPECT_NEAR(bending, expected, 0.01 * expected);
}

TEST(Membrane, RestLengthsFollowTheInnerRadiiOfRings) {
  Membrane membrane;
  EXPECT_DOUBLE_EQ(membrane.rest_length(-1, 2), membrane.length);
  membrane.ring_width = 1.0;
  const auto inner_radius = [&](int size) {
    // Of a ring whose bonds are as long as those of hexagons whose centers are L apart.
    return 0.5 * membrane.length * std::tan(std::acos(-1.0) / 6.0) /
           std::tan(std::acos(-1.0) / size);
  };
  for (const int size : {4, 5, 6, 7, 8}) {
    EXPECT_NEAR(membrane.rest_length(size - 6, 1), inner_radius(size) + inner_radius(7), 1e-12);
  }
}

TEST(Membrane, StepsOfABoundaryCostNothing) {
  Membrane membrane;
  membrane.pentagon = 1.7;
  membrane.heptagon = -1.2;
  EXPECT_DOUBLE_EQ(membrane.boundary_energy(0), 0.0);
  EXPECT_DOUBLE_EQ(membrane.boundary_energy(1) + membrane.boundary_energy(-1), 0.0);
  // A pentagon and a step are to a hexagon what a heptagon and the other step are.
  EXPECT_NEAR(membrane.core_energy(-1) + membrane.boundary_energy(1),
              membrane.core_energy(1) + membrane.boundary_energy(-1), 1e-12);
  EXPECT_GT(membrane.boundary_energy(2) + membrane.boundary_energy(-2), 2.0 * membrane.octagon);
}

TEST(Membrane, BoundariesHaveTheEdgesOfSomeTube) {
  Membrane membrane;
  for (const auto& [n, m] : {std::pair(10, 0), std::pair(10, 10), std::pair(12, 5)}) {
    // The edge of a tube is a path of n + m edges around it.
    const double around = membrane.length * std::sqrt(n * n + n * m + m * m);
    EXPECT_NEAR(membrane.boundary_count_energy(around, n + m), 0.0, 1e-12);
  }
  EXPECT_GT(membrane.boundary_count_energy(10.0 * membrane.length, 9), 1.0);
  EXPECT_GT(membrane.boundary_count_energy(10.0 * membrane.length, 13), 1.0);
}

TEST(MembraneNet, CountsCoresAndPairs) {
  // Twelve pentagons; a flip among hexagons makes two more and two heptagons, with four edges
  // between them.
  TriMesh sphere = make_shape("sphere", {}, 0.25);
  for (const auto e : sphere.edges()) {
    const bool is_regular = e.v0().valence() == 6 && e.v1().valence() == 6 &&
                            e.h0().next().to().valence() == 6 && e.h1().next().to().valence() == 6;
    if (!is_regular) continue;
    sphere.flip(e);
    break;
  }
  Membrane membrane;
  membrane.pentagon = 1.0;
  membrane.heptagon = 10.0;
  membrane.pair = 100.0;
  ConstrainedMesh constrained(sphere, {});
  const MembraneNet net(constrained, sphere, membrane);
  EXPECT_DOUBLE_EQ(net.core_energy(), 14.0 + 20.0 + 400.0);
}

TEST(MembraneEnergy, GradientByAnImageIsThatByItsVertex) {
  const Membrane membrane;
  const Lattice lattice(Eigen::Vector3d(7.0, 8.0, 9.0).asDiagonal(), {true, true, false});
  LanePositions x = scattered_lanes(4);
  VertexImages images(x.size());
  const int beyond = images.number(1, {1, 0, 0});
  const int far = images.number(2, {1, -1, 0});
  EXPECT_EQ(images.number(1, {1, 0, 0}), beyond);
  EXPECT_EQ(images.number(3, {0, 0, 0}), 3);
  EXPECT_EQ(images.vertex_of(far), 2);
  const MembraneTerms<double> terms = {.hinges = {{0, beyond, 2, 3}, {beyond, far, 0, 3}},
                                       .contacts = {{0, beyond}}};
  const auto energy_at = [&](LanePositions at, LanePositions& gradient) {
    images.place(lattice, at);
    gradient.assign(at.size(), Lanes<double>::Zero());
    const double energy = membrane_energy(membrane, terms, at, gradient);
    images.collect(gradient);
    return energy;
  };
  LanePositions gradient;
  const double energy = energy_at(x, gradient);
  constexpr double step = 1e-5;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      LanePositions ignored;
      LanePositions moved = x;
      moved[i][k] += step;
      const double above = energy_at(moved, ignored);
      moved[i][k] -= 2.0 * step;
      const double below = energy_at(moved, ignored);
      EXPECT_NEAR(gradient[i][k], (above - below) / (2.0 * step), 1e-6 * (1.0 + energy));
    }
  }
}

TEST(MembranePreconditioner, InvertsTheHessianOfAVertexWhoseSpringsAreAtRest) {
  const Membrane membrane;
  const double length = membrane.length;
  const double height = 0.5 * std::sqrt(3.0) * length;
  LanePositions x = {{0.0, 0.0, 0.0, 0.0}};
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::acos(0.5);
    x.emplace_back(length * std::cos(angle), 0.6 * length * std::sin(angle),
                   0.8 * length * std::sin(angle), 0.0);
  }
  x.emplace_back(1.5 * length, 0.6 * height, 0.8 * height, 0.0);
  const MembraneTerms<double> terms = {
      .hinges =
          {{0, 1, 2, 6}, {0, 2, 3, 1}, {0, 3, 4, 2}, {0, 4, 5, 3}, {0, 5, 6, 4}, {1, 2, 7, 0}},
      .edges = {{0, 6}},
      .tethers = {{0, 0.7, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.6, 0.8, 0.0}}}};
  const MembranePreconditioner<double> inverse(membrane, terms, x, 1, VertexImages(x.size()));
  constexpr double step = 1e-4 * Membrane::fine_length;
  for (int k = 0; k < 3; ++k) {
    const auto gradient_at = [&](double moved) {
      LanePositions there = x;
      there[0][k] += moved;
      LanePositions gradient(x.size(), Lanes<double>::Zero());
      static_cast<void>(membrane_energy(membrane, terms, there, gradient));
      return gradient[0];
    };
    Eigen::VectorXd column = (gradient_at(step) - gradient_at(-step)) / (2.0 * step);
    inverse.apply(column);
    // It adds 1e-4 of the trace, at most a hundredth of the soft direction.
    EXPECT_TRUE(column.isApprox(Eigen::VectorXd::Unit(4, k), 0.02)) << column;
  }
}

/// A strip of triangles in a plane that is bent about an axis across it, and held at one end.
struct BentStrip {
  LanePositions x;
  MembraneTerms<double> terms;

  explicit BentStrip(int n) {
    const double length = Membrane::fine_length;
    const double height = 0.5 * std::sqrt(3.0) * length;
    for (int i = 0; i < n; ++i) {
      const double along = 0.5 * length * i;
      x.emplace_back(along, i % 2 == 0 ? 0.0 : height, 0.002 * along * along, 0.0);
    }
    for (int i = 0; i + 1 < n; ++i) {
      if (i == 0 || i + 2 == n) {
        terms.edges.push_back({i, i + 1});
      } else {
        terms.hinges.push_back({i, i + 1, i - 1, i + 2});
      }
      if (i + 2 < n) terms.edges.push_back({i, i + 2});
    }
    for (int i = 0; i < 3; ++i) {
      const Lanes<double> foot = {x[std::size_t(i)][0], x[std::size_t(i)][1], 0.0, 0.0};
      for (int k = 0; k < 3; ++k) terms.tethers.push_back({i, 10.0, foot, Lanes<double>::Unit(k)});
    }
  }
};

TEST(MembraneLaplacian, InvertsTheStiffnessOfSpringsThatPullInAllDirections) {
  const Membrane membrane;
  const BentStrip strip(12);
  const std::size_t n = strip.x.size();
  const MembraneLaplacian inverse(membrane, strip.terms, n, VertexImages(n));
  const Eigen::VectorXd moved = Eigen::VectorXd::LinSpaced(4 * Eigen::Index(n), -1.0, 2.0);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(moved.size());
  const auto of = [](Eigen::VectorXd& v, int i) { return v.segment<3>(4 * i); };
  const auto at = [&](int i) { return moved.segment<3>(4 * i); };
  const auto add_spring = [&](int a, int b) {
    const Eigen::Vector3d pull = 0.5 * membrane.stretching * (at(a) - at(b));
    of(forces, a) += pull;
    of(forces, b) -= pull;
  };
  for (const Hinge& h : strip.terms.hinges) add_spring(h.a, h.b);
  for (const auto& [a, b] : strip.terms.edges) add_spring(a, b);
  for (const auto& tether : strip.terms.tethers) {
    of(forces, tether.i) += tether.stiffness / 3.0 * at(tether.i);
  }
  inverse.apply(forces);
  for (int i = 0; i < int(n); ++i) {
    // Every vertex is anchored by 1e-4 of a spring's stiffness as well.
    EXPECT_LT((of(forces, i) - at(i)).norm(), 0.01) << i;
  }
}

TEST(MembraneLaplacian, AnImageMovesWithItsVertex) {
  const Membrane membrane;
  VertexImages images(2);
  const int next = images.number(0, {1, 0, 0});
  const MembraneTerms<double> terms = {.edges = {{0, 1}, {1, next}}};
  const MembraneLaplacian inverse(membrane, terms, 2, images);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(8);
  forces[0] = 1.0;
  forces[4] = -1.0;
  inverse.apply(forces);
  // Two springs of k/2 join the two.
  EXPECT_NEAR(forces[0] - forces[4], 1.0 / membrane.stretching, 1e-3 * forces[0]);
}

TEST(MinimizeMembrane, FindsTheSameMinimumAcrossTheNetInFewerSteps) {
  const Membrane membrane;
  const BentStrip strip(60);
  const std::size_t n = strip.x.size();
  const Lattice none;
  const VertexImages images(n);
  const auto steps_to_minimum = [&](bool across_net) {
    Lbfgs<double> minimizer;
    std::vector<Eigen::Vector3d> positions;
    for (const auto& x : strip.x) positions.emplace_back(x.head<3>());
    int steps = 0;
    const double energy = minimize_membrane(
        minimizer, {membrane, strip.terms, images, none}, positions,
        {.max_steps = 5000, .tolerance = 1e-9, .across_net = across_net}, [&](double, double) {
          ++steps;
          return false;
        });
    EXPECT_NEAR(energy, 0.0, 1e-5) << across_net << steps;  // flat, with equal edges
    return steps;
  };
  EXPECT_LT(2 * steps_to_minimum(true), steps_to_minimum(false));
}

}  // namespace
}  // namespace trivalent::remesh
