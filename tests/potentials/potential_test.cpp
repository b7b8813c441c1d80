#include "trivalent/potentials/potential.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "structures.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/rebo.h"

namespace {

using namespace trivalent::potentials;  // NOLINT(google-build-using-namespace): the unit under test
using trivalent::testing_support::displace;
using trivalent::testing_support::graphene;

struct Case {
  std::string name;
  std::function<std::unique_ptr<Potential>()> make;
  std::function<EnergyForces(const Atoms&)> evaluate_once;
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

class EveryPotential : public testing::TestWithParam<Case> {};

void expect_same_bytes(const EnergyForces& a, const EnergyForces& b) {
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.energies, b.energies);
  EXPECT_EQ(a.forces, b.forces);
  EXPECT_EQ(a.virial, b.virial);
}

Atoms sheet() {
  Atoms atoms = graphene(4, 3, 1.42);
  displace(atoms, 0.05, 3);
  return atoms;
}

TEST_P(EveryPotential, ComesNearTheFreeFunctionOfItsName) {
  const auto potential = GetParam().make();
  EXPECT_NEAR(potential->evaluate(sheet()).energy, GetParam().evaluate_once(sheet()).energy, 1e-9);
}

TEST_P(EveryPotential, IgnoresTheValuesOfTheMemoryItIsGiven) {
  const auto potential = GetParam().make();
  EnergyForces other = potential->evaluate(graphene(6, 6, 1.3));
  other.virial.setOnes();
  const EnergyForces reused = potential->evaluate(sheet(), std::move(other));
  expect_same_bytes(reused, GetParam().make()->evaluate(sheet()));
}

TEST_P(EveryPotential, GivesTheBytesOfANewOneOnceItHasForgotten) {
  const auto potential = GetParam().make();
  Atoms moved = sheet();
  (void)potential->evaluate(moved);
  moved.positions[0] += Eigen::Vector3d(0.5, 0.0, 0.0);  // irregular for a while
  (void)potential->evaluate(moved);
  moved = sheet();
  displace(moved, 0.02, 4);
  (void)potential->evaluate(moved);
  potential->forget();
  expect_same_bytes(potential->evaluate(moved), GetParam().make()->evaluate(moved));
}

INSTANTIATE_TEST_SUITE_P(
    Potential, EveryPotential,
    testing::Values(Case{"Rebo", [] { return std::make_unique<Rebo>(); },
                         [](const Atoms& atoms) { return rebo(atoms); }},
                    Case{"Airebo", [] { return std::make_unique<Airebo>(); },
                         [](const Atoms& atoms) { return airebo(atoms); }},
                    Case{"LennardJones", [] { return std::make_unique<LennardJones>(); },
                         [](const Atoms& atoms) { return lennard_jones(atoms); }}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
