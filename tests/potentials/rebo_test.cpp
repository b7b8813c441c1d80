#include "trivalent/potentials/rebo.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "energy_checks.h"
#include "structures.h"
#include "trivalent/potentials/error.h"

namespace trivalent::potentials {
namespace {

using testing_support::cube;
using testing_support::diamond;
using testing_support::displace;
using testing_support::graphene;
using testing_support::periodic;
using testing_support::random_hydrocarbon;

EnergyForces evaluate(const Atoms& atoms) { return rebo(atoms); }

std::vector<Atoms> disordered_structures() {
  Atoms sheet = graphene(3, 2, 1.42);
  displace(sheet, 0.1, 1);
  Atoms stretched = graphene(2, 1, 1.75);
  displace(stretched, 0.1, 2);
  Atoms crystal = diamond(1, 3.3);
  displace(crystal, 0.15, 3);
  return {sheet,
          stretched,
          crystal,
          testing_support::bent_ethane(),
          random_hydrocarbon(40, cube(5.5), 0.9, 4),
          random_hydrocarbon(40, periodic(cube(5.5)), 0.9, 5)};
}

// Minimum of LAMMPS pair_style rebo with CH.rebo; [Brenner2002] prints -7.395 eV and 1.42 Å.
TEST(Rebo, HasGrapheneAtItsPublishedMinimum) {
  const auto result = rebo(graphene(3, 2, 1.42039010727));
  for (const double energy : result.energies) EXPECT_NEAR(energy, -7.39499725165, 1e-10);
  EXPECT_NEAR(result.virial(0, 0), 0.0, 1e-7);  // the bond is known to eleven digits
}

// Minimum of LAMMPS pair_style rebo with CH.rebo; [Brenner2002] prints -7.37 eV.
TEST(Rebo, HasDiamondAtItsPublishedMinimum) {
  const auto result = rebo(diamond(2, 3.56571570992));
  for (const double energy : result.energies) EXPECT_NEAR(energy, -7.36999664105, 1e-9);
}

TEST(Rebo, GivesTheSameForACellAndItsMultiples) {
  const double one = rebo(diamond(1, 3.5)).energy;
  EXPECT_NEAR(8.0 * one, rebo(diamond(2, 3.5)).energy, 1e-10);
  EXPECT_NEAR(6.0 * rebo(graphene(1, 1, 1.45)).energy, rebo(graphene(2, 3, 1.45)).energy, 1e-10);
}

// The primitive cell of graphene: two atoms, each a neighbor of the other three times over.
TEST(Rebo, EvaluatesThePrimitiveTriclinicCell) {
  constexpr double bond = 1.42;
  const double a = std::sqrt(3.0) * bond;
  Atoms atoms;
  atoms.positions = {{0, 0, 0}, {a / 2.0, bond / 2.0, 0}};
  atoms.species.assign(2, Species::carbon);
  atoms.box.cell << a, a / 2.0, 0, 0, 1.5 * bond, 0, 0, 0, 20;
  atoms.box.periodic = {true, true, true};
  EXPECT_NEAR(rebo(atoms).energies[0], rebo(graphene(2, 2, bond)).energies[0], 1e-12);
}

TEST(Rebo, LeavesALoneAtomAlone) {
  Atoms atoms;
  atoms.positions = {{1, 2, 3}};
  atoms.species = {Species::carbon};
  const auto result = rebo(atoms);
  EXPECT_EQ(result.energy, 0.0);
  EXPECT_EQ(result.forces[0].norm(), 0.0);
}

TEST(Rebo, IsZeroWithoutAtoms) { EXPECT_EQ(rebo(Atoms{}).energy, 0.0); }

TEST(Rebo, ForcesAreMinusTheGradientOfTheEnergy) {
  for (const Atoms& atoms : disordered_structures()) {
    testing_support::expect_forces_match_energy(atoms, evaluate, 1e-7);
  }
}

TEST(Rebo, VirialIsMinusTheStrainDerivativeOfTheEnergy) {
  for (const Atoms& atoms : disordered_structures()) {
    testing_support::expect_virial_matches_energy(atoms, evaluate, 1e-6);
  }
}

TEST(Rebo, ForcesAndEnergiesAddUp) {
  for (const Atoms& atoms : disordered_structures()) {
    testing_support::expect_no_net_force(rebo(atoms));
    testing_support::expect_energies_add_up(rebo(atoms));
  }
}

TEST(Rebo, TurnsWithTheAtoms) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(31.0, -7.5, 2.25);
  for (const Atoms& atoms : disordered_structures()) {
    Atoms turned = atoms;
    for (Eigen::Vector3d& x : turned.positions) x = (turn * x + shift).eval();
    turned.box.cell = turn * atoms.box.cell;
    const auto before = rebo(atoms);
    const auto after = rebo(turned);
    EXPECT_NEAR(after.energy, before.energy, 1e-11 * std::abs(before.energy));
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      const double scale = 1.0 + before.forces[i].norm();
      EXPECT_LT((after.forces[i] - turn * before.forces[i]).norm(), 1e-9 * scale);
    }
  }
}

TEST(Rebo, DoesNotDependOnTheOrderOfTheAtoms) {
  const Atoms atoms = random_hydrocarbon(40, periodic(cube(5.5)), 0.9, 5);
  Atoms backwards = atoms;
  std::ranges::reverse(backwards.positions);
  std::ranges::reverse(backwards.species);
  const auto one = rebo(atoms);
  const auto other = rebo(backwards);
  EXPECT_NEAR(one.energy, other.energy, 1e-12 * std::abs(one.energy));
  EXPECT_LT((one.forces[3] - other.forces[atoms.size() - 4]).norm(), 1e-10);
}

TEST(Rebo, StaysFiniteForCollidingAndCrowdedAtoms) {
  const auto crowded = rebo(random_hydrocarbon(200, periodic(cube(5.0)), 0.05, 6));
  EXPECT_TRUE(std::isfinite(crowded.energy));
  for (const auto& force : crowded.forces) EXPECT_TRUE(force.allFinite());
}

TEST(Rebo, RefusesAtomsThatAreTooDenseForAnyPotential) {
  Atoms line = graphene(2, 1, 1.42);
  line.box = {};
  line.positions.clear();
  for (int k = 0; k < 300; ++k) line.positions.emplace_back(0.005 * k, 0.0, 0.0);
  line.species.assign(line.positions.size(), Species::carbon);
  EXPECT_THROW((void)rebo(line), InvalidAtoms);
}

TEST(Rebo, ThrowsOnBadInput) {
  Atoms atoms = graphene(2, 1, 1.42);
  Atoms twice = atoms;
  twice.positions[1] = twice.positions[0];
  EXPECT_THROW((void)rebo(twice), InvalidAtoms);
  Atoms broken = atoms;
  broken.positions[2][2] = std::nan("");
  EXPECT_THROW((void)rebo(broken), InvalidAtoms);
  Atoms boxless = atoms;
  boxless.box.cell.setZero();
  EXPECT_THROW((void)rebo(boxless), InvalidAtoms);
  Atoms nameless = atoms;
  nameless.species.pop_back();
  EXPECT_THROW((void)rebo(nameless), InvalidAtoms);
  EXPECT_THROW((void)rebo(atoms, {.skin = -0.1}), InvalidOption);
}

}  // namespace
}  // namespace trivalent::potentials
