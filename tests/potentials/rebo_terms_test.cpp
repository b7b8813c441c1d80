#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "energy_checks.h"
#include "rebo/angular_function.h"
#include "rebo/bond_list.h"
#include "rebo/bond_order.h"
#include "rebo/cutoff.h"
#include "rebo/gradient.h"
#include "rebo/pair_terms.h"
#include "rebo/parameters.h"
#include "rebo/splines.h"
#include "structures.h"
#include "totals.h"

namespace trivalent::potentials::rebo_detail {
namespace {

using testing_support::cube;
using testing_support::periodic;

constexpr double step = 1e-5;         // central differences: error ~ step² · third derivative
constexpr double slope_error = 1e-6;  // of functions of order one

double difference_quotient(const std::function<double(double)>& f, double x) {
  return (f(x + step) - f(x - step)) / (2.0 * step);
}

TEST(CosineSwitch, GoesFromOneToZero) {
  const Range range = {1.7, 2.0};
  EXPECT_EQ(cosine_switch(1.7, range).value, 1.0);
  EXPECT_NEAR(cosine_switch(1.85, range).value, 0.5, 1e-15);
  EXPECT_EQ(cosine_switch(2.0, range).value, 0.0);
  const auto value = [&](double x) { return cosine_switch(x, range).value; };
  EXPECT_NEAR(cosine_switch(1.8, range).slope, difference_quotient(value, 1.8), slope_error);
}

TEST(CubicRise, GoesFromZeroToOne) {
  EXPECT_EQ(cubic_rise(-1.0, straight_angle).value, 0.0);
  EXPECT_EQ(cubic_rise(-0.995, straight_angle).value, 1.0);
  const auto value = [](double x) { return cubic_rise(x, {0.0, 2.0}).value; };
  EXPECT_NEAR(cubic_rise(0.6, {0.0, 2.0}).slope, difference_quotient(value, 0.6), slope_error);
}

ValueAndSlope cut_repulsion(double r, const BondParameters& bond) {
  return repulsion(r, cosine_switch(r, bond.cutoff), bond);
}
ValueAndSlope cut_attraction(double r, const BondParameters& bond) {
  return attraction(r, cosine_switch(r, bond.cutoff), bond);
}

TEST(PairTerms, SlopesAreTheDerivatives) {
  for (const Parameters* parameters : {&brenner_2002, &stuart_2000}) {
    for (const BondParameters& bond : parameters->bonds) {
      for (const double r : {0.8, 1.05, 1.42, 1.5, 1.65, 1.79}) {
        const auto repelled = [&](double x) { return cut_repulsion(x, bond).value; };
        const auto attracted = [&](double x) { return cut_attraction(x, bond).value; };
        EXPECT_NEAR(cut_repulsion(r, bond).slope, difference_quotient(repelled, r), 2e-5);
        EXPECT_NEAR(cut_attraction(r, bond).slope, difference_quotient(attracted, r), 2e-5);
      }
    }
  }
}

TEST(PairTerms, EndAtTheCutoffAndAreFiniteAtCollisions) {
  for (const BondParameters& bond : brenner_2002.bonds) {
    EXPECT_EQ(cut_repulsion(bond.cutoff.end, bond).value, 0.0);
    EXPECT_EQ(cut_attraction(bond.cutoff.end, bond).slope, 0.0);
    EXPECT_TRUE(std::isfinite(cut_repulsion(1e-6, bond).value));
  }
}

// Values, slopes and curvatures of the printed table, [Brenner2002, Table 3].
TEST(AngularFunction, HasThePrintedValuesOfCarbon) {
  const auto few = [](double c) { return angular_function(Species::carbon, c, 2.0); };
  const auto many = [](double c) { return angular_function(Species::carbon, c, 4.0); };
  constexpr double printed = 2e-5;  // five digits in print
  EXPECT_NEAR(few(-1.0).value, -0.01, printed);
  EXPECT_NEAR(few(-1.0).slope_cosine, 0.104, printed);
  EXPECT_NEAR(few(-0.5).value, 0.0528, printed);
  EXPECT_NEAR(few(-0.5).slope_cosine, 0.17, printed);
  EXPECT_NEAR(few(-1.0 / 3.0).value, 0.09733, printed);
  EXPECT_NEAR(few(0.0).value, 0.271856, printed);
  EXPECT_NEAR(few(0.5).value, 0.416335, printed);
  EXPECT_NEAR(few(1.0).value, 1.0, printed);
  EXPECT_NEAR(many(0.0).value, 0.37545, printed);
  EXPECT_NEAR(many(0.5).value, 2.0014, 1e-4);
  EXPECT_NEAR(many(1.0).value, 8.0, printed);
}

TEST(AngularFunction, IsSmoothAtItsKnots) {
  for (const double coordination : {2.0, 3.4, 4.0}) {
    for (const double knot : {-2.0 / 3.0, -0.5, -1.0 / 3.0}) {
      const auto below = angular_function(Species::carbon, knot - 1e-9, coordination);
      const auto above = angular_function(Species::carbon, knot + 1e-9, coordination);
      EXPECT_NEAR(below.value, above.value, 1e-8);
      EXPECT_NEAR(below.slope_cosine, above.slope_cosine, 1e-7);
    }
  }
}

TEST(AngularFunction, SlopesAreTheDerivatives) {
  for (const Species center : {Species::carbon, Species::hydrogen}) {
    for (const double c : {-0.9, -0.6, -0.4, 0.1, 0.8}) {
      for (const double N : {2.1, 3.3, 3.5, 3.9}) {
        const AngularValue g = angular_function(center, c, N);
        const auto by_cosine = [&](double x) { return angular_function(center, x, N).value; };
        const auto by_N = [&](double x) { return angular_function(center, c, x).value; };
        EXPECT_NEAR(g.slope_cosine, difference_quotient(by_cosine, c), 1e-5);
        EXPECT_NEAR(g.slope_coordination, difference_quotient(by_N, N), 1e-5);
      }
    }
  }
}

TEST(TricubicSpline, TakesKnotsAndTheirSlopesFromTheTable) {
  const TricubicSpline& pi = pi_splines[0];
  EXPECT_EQ(pi(2.0, 1.0, 5.0).value, -0.0133778774);
  EXPECT_EQ(pi(1.0, 2.0, 5.0).value, -0.0133778774);
  EXPECT_EQ(pi(2.0, 1.0, 5.0).slope_x, -0.027188);
  EXPECT_EQ(pi(1.0, 2.0, 5.0).slope_y, -0.027188);
  EXPECT_EQ(pi(2.0, 2.0, 4.0).slope_z, -0.003309);
  EXPECT_EQ(pi(4.0, 2.0, 7.0).value, -0.0223546915);  // 4 neighbors count as 3
  EXPECT_EQ(pi(2.0, 2.0, 9.0).value, 0.0);            // graphite
}

TEST(TricubicSpline, SlopesAreTheDerivatives) {
  for (const TricubicSpline& spline : pi_splines) {
    for (const auto& [x, y, z] : {std::array{1.3, 2.6, 4.4}, {0.2, 0.9, 1.1}, {2.7, 3.5, 8.9}}) {
      const Value3 s = spline(x, y, z);
      const auto by_x = [&](double t) { return spline(t, y, z).value; };
      const auto by_y = [&](double t) { return spline(x, t, z).value; };
      const auto by_z = [&](double t) { return spline(x, y, t).value; };
      EXPECT_NEAR(s.slope_x, difference_quotient(by_x, x), slope_error);
      EXPECT_NEAR(s.slope_y, difference_quotient(by_y, y), slope_error);
      EXPECT_NEAR(s.slope_z, difference_quotient(by_z, z), slope_error);
    }
  }
}

TEST(TricubicSpline, IsFlatOutsideItsKnots) {
  const Value3 inside = pi_splines[0](2.0, 1.4, 9.0);
  const Value3 beyond = pi_splines[0](2.0, 1.4, 11.0);
  EXPECT_EQ(inside.value, beyond.value);
  EXPECT_EQ(beyond.slope_z, 0.0);
  EXPECT_EQ(pi_splines[0](5.5, 1.4, 3.0).slope_x, 0.0);
  EXPECT_EQ(pi_splines[0](2.0, -1e-17, 3.0).value, pi_splines[0](2.0, 0.0, 3.0).value);
}

TEST(BicubicSpline, SlopesAreTheDerivatives) {
  const Value2 p = brenner_2002.p_ch(1.2, 0.7);
  const auto by_x = [](double x) { return brenner_2002.p_ch(x, 0.7).value; };
  const auto by_y = [](double y) { return brenner_2002.p_ch(1.2, y).value; };
  EXPECT_NEAR(p.slope_x, difference_quotient(by_x, 1.2), slope_error);
  EXPECT_NEAR(p.slope_y, difference_quotient(by_y, 0.7), slope_error);
}

// One term of the bond order alone as an energy, summed over all directed bonds.
using Term = double (BondOrder::*)(const Pair&, double) const;

EnergyForces energy_of_term(const Atoms& atoms, Term term) {
  EnergyForces result;
  set_zero(result, atoms.size());
  const BondList bonds(atoms, stuart_2000);  // its P_CC is not zero for pure carbon
  Gradient gradient(bonds, result);
  const BondOrder orders(bonds, stuart_2000, &gradient);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    // Times the length of the bond, so that the weight depends on the positions too.
    const double length = bonds[b].distance - bonds[b].cutoff.value;
    const double cut = bonds[b].cutoff.value;
    const double value = (orders.*term)(pair_of(bonds, b), length * cut);
    const double slope = (1.0 - bonds[b].cutoff.slope) * cut + length * bonds[b].cutoff.slope;
    gradient.add_distance(bonds[b], value * slope);
    result.energy += value * length * cut;
  }
  gradient.finish();
  return result;
}

class BondOrderTerm : public testing::TestWithParam<Term> {
 public:
  static EnergyForces potential(const Atoms& atoms) { return energy_of_term(atoms, GetParam()); }
};

TEST_P(BondOrderTerm, ForcesAreMinusTheGradient) {
  constexpr double tolerance = 1e-7;  // finite differences across curvature jumps of the cutoffs
  Atoms sheet = testing_support::graphene(2, 1, 1.6);
  testing_support::displace(sheet, 0.1, 1);
  testing_support::expect_forces_match_energy(sheet, potential, tolerance);
  Atoms crystal = testing_support::diamond(1, 3.4);
  testing_support::displace(crystal, 0.12, 2);
  testing_support::expect_forces_match_energy(crystal, potential, tolerance);
  testing_support::expect_forces_match_energy(testing_support::bent_ethane(), potential, tolerance);
  testing_support::expect_forces_match_energy(
      testing_support::random_hydrocarbon(40, periodic(cube(5.5)), 1.0, 4), potential, tolerance);
}

TEST_P(BondOrderTerm, VirialIsMinusTheStrainDerivative) {
  testing_support::expect_virial_matches_energy(
      testing_support::random_hydrocarbon(30, periodic(cube(5.5)), 1.0, 5), potential, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Each, BondOrderTerm,
                         testing::Values(&BondOrder::sigma, &BondOrder::pi,
                                         &BondOrder::dihedral_sum, &BondOrder::bond_order));

TEST(DihedralSum, IsZeroInAPlaneAndLargestAcrossIt) {
  // Two ends with one neighbor each: sin²Θ is all there is.
  Atoms atoms;
  atoms.positions = {{0, 0, 0}, {1.4, 0, 0}, {-0.7, 1.2, 0}, {2.1, 1.2, 0}};
  atoms.species.assign(4, Species::carbon);
  const auto sum = [&] {
    const BondList bonds(atoms, brenner_2002);
    return BondOrder(bonds, brenner_2002, nullptr).dihedral_sum(pair_of(bonds, 0), 0.0);
  };
  EXPECT_NEAR(sum(), 0.0, 1e-15);
  atoms.positions[3] = {2.1, 0.0, 1.2};
  EXPECT_NEAR(sum(), 1.0, 1e-15);
}

}  // namespace
}  // namespace trivalent::potentials::rebo_detail
