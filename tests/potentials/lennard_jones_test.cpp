#include "trivalent/potentials/lennard_jones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "energy_checks.h"
#include "random_atoms.h"
#include "trivalent/potentials/error.h"

namespace trivalent::potentials {
namespace {

using testing_support::cube;
using testing_support::periodic;

Atoms dimer(double distance) {
  Atoms atoms;
  atoms.positions = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, distance, 0.0)};
  atoms.species.assign(2, Species::carbon);
  return atoms;
}

// Atoms far enough apart that energies stay of the order of epsilon.
Atoms loose_crystal(const Box& box) {
  Atoms atoms;
  atoms.box = box;
  for (int k = 0; k < 27; ++k) {
    atoms.positions.emplace_back(3.7 * Eigen::Vector3d(k % 3, k / 3 % 3, k / 9));
    atoms.species.push_back(Species::carbon);
  }
  testing_support::displace(atoms, 0.1, 1);
  return atoms;
}

EnergyForces with_defaults(const Atoms& atoms) { return lennard_jones(atoms); }

TEST(LennardJones, HasItsMinimumWhereTheFormulaSays) {
  const LennardJonesOptions options;
  const auto result = lennard_jones(dimer(options.sigma * std::pow(2.0, 1.0 / 6.0)), options);
  EXPECT_NEAR(result.energy, -options.epsilon, 1e-15);
  EXPECT_NEAR(result.forces[0].norm(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(result.energies[0], result.energies[1]);
}

TEST(LennardJones, CrossesZeroAtSigma) {
  EXPECT_NEAR(lennard_jones(dimer(3.4)).energy, 0.0, 1e-16);
}

TEST(LennardJones, IsZeroFromTheCutoffOn) {
  EXPECT_EQ(lennard_jones(dimer(10.2)).energy, 0.0);
  EXPECT_LT(lennard_jones(dimer(10.1999)).energy, 0.0);
}

TEST(LennardJones, IsContinuousAtTheCutoffWhenShifted) {
  EXPECT_NEAR(lennard_jones(dimer(10.2 - 1e-9), {.shift = true}).energy, 0.0, 1e-14);
}

TEST(LennardJones, ForcesAreMinusTheGradientOfTheEnergy) {
  testing_support::expect_forces_match_energy(loose_crystal(cube(11.1)), with_defaults, 1e-10);
  testing_support::expect_forces_match_energy(loose_crystal(periodic(cube(11.1))), with_defaults,
                                              1e-10);
}

TEST(LennardJones, VirialIsMinusTheStrainDerivativeOfTheEnergy) {
  testing_support::expect_virial_matches_energy(loose_crystal(cube(11.1)), with_defaults, 1e-8);
  // Unshifted energies jump as pairs cross the cutoff, which a periodic strain makes them do.
  testing_support::expect_virial_matches_energy(
      loose_crystal(periodic(cube(11.1))),
      [](const Atoms& atoms) { return lennard_jones(atoms, {.shift = true}); }, 1e-5);
}

TEST(LennardJones, ForcesAndEnergiesAddUp) {
  const auto result = lennard_jones(loose_crystal(periodic(cube(11.1))));
  testing_support::expect_no_net_force(result);
  testing_support::expect_energies_add_up(result);
}

TEST(LennardJones, AgreesBetweenACellAndItsMultiples) {
  Atoms one;
  one.box = periodic(cube(3.8));
  one.positions = {Eigen::Vector3d(0.1, 0.2, 0.3)};
  one.species = {Species::carbon};
  Atoms eight;
  eight.box = periodic(cube(7.6));
  for (int k = 0; k < 8; ++k) {
    eight.positions.emplace_back(one.positions[0] + 3.8 * Eigen::Vector3d(k % 2, k / 2 % 2, k / 4));
    eight.species.push_back(Species::carbon);
  }
  EXPECT_NEAR(8.0 * lennard_jones(one).energy, lennard_jones(eight).energy, 1e-13);
}

TEST(LennardJones, ThrowsOnBadInput) {
  EXPECT_THROW((void)lennard_jones(dimer(0.0)), InvalidAtoms);
  EXPECT_THROW((void)lennard_jones(dimer(std::nan(""))), InvalidAtoms);
  EXPECT_THROW((void)lennard_jones(dimer(1.0), {.sigma = 0.0}), InvalidOption);
  EXPECT_THROW((void)lennard_jones(dimer(1.0), {.cutoff = -1.0}), InvalidOption);
  EXPECT_THROW((void)lennard_jones(dimer(1.0), {.epsilon = std::nan("")}), InvalidOption);
}

}  // namespace
}  // namespace trivalent::potentials
