#include "trivalent/potentials/airebo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "energy_checks.h"
#include "structures.h"
#include "trivalent/potentials/error.h"

namespace trivalent::potentials {
namespace {

using testing_support::cube;
using testing_support::displace;
using testing_support::graphene;
using testing_support::periodic;
using testing_support::random_hydrocarbon;

std::vector<Atoms> small_disordered_structures() {
  Atoms sheet = graphene(2, 1, 1.5);
  displace(sheet, 0.1, 1);
  return {sheet, testing_support::bent_ethane(), random_hydrocarbon(30, cube(6.5), 1.0, 2),
          random_hydrocarbon(24, periodic(cube(6.2)), 1.0, 3)};
}

// Minimum of LAMMPS pair_style airebo 3.0 0 0 with CH.airebo.
TEST(Airebo, HasTheBondsOfItsOwnGraphene) {
  const auto result =
      airebo(graphene(3, 2, 1.39767464739), {.lennard_jones = false, .torsion = false});
  for (const double energy : result.energies) EXPECT_NEAR(energy, -7.80741782101, 1e-9);
}

TEST(Airebo, HasTorsionInAFlatSheet) {
  const Atoms sheet = graphene(3, 2, 1.42);
  const double with = airebo(sheet, {.lennard_jones = false}).energy;
  const double without = airebo(sheet, {.lennard_jones = false, .torsion = false}).energy;
  // Per bond two cis and two trans angles, [Stuart2000, eq. 16]; one and a half bonds per atom.
  const double per_bond = 0.3078851086 * (2.0 * (256.0 / 405.0 - 0.1) - 2.0 * 0.1);
  EXPECT_NEAR(with - without, 24.0 * 1.5 * per_bond, 1e-10);
}

TEST(Airebo, AttractsLayersThatNoBondConnects) {
  Atoms layers = graphene(3, 2, 1.4);
  const Atoms one = layers;
  for (const Eigen::Vector3d& x : one.positions) {
    layers.positions.emplace_back(x + Eigen::Vector3d(0.0, 1.4, 3.4));
    layers.species.push_back(Species::carbon);
  }
  EXPECT_LT(airebo(layers).energy, 2.0 * airebo(one).energy - 0.5);
}

TEST(Airebo, ForcesAreMinusTheGradientOfTheEnergy) {
  for (const Atoms& atoms : small_disordered_structures()) {
    for (const AireboOptions options :
         {AireboOptions{true, false}, AireboOptions{false, true}, AireboOptions{true, true}}) {
      testing_support::expect_forces_match_energy(
          atoms, [&](const Atoms& moved) { return airebo(moved, options); }, 1e-6);
    }
  }
}

TEST(Airebo, VirialIsMinusTheStrainDerivativeOfTheEnergy) {
  for (const Atoms& atoms : small_disordered_structures()) {
    testing_support::expect_virial_matches_energy(
        atoms, [](const Atoms& strained) { return airebo(strained); }, 1e-5);
  }
}

TEST(Airebo, ForcesAndEnergiesAddUp) {
  for (const Atoms& atoms : small_disordered_structures()) {
    testing_support::expect_no_net_force(airebo(atoms));
    testing_support::expect_energies_add_up(airebo(atoms));
  }
}

TEST(Airebo, ThrowsOnCoincidentAtoms) {
  Atoms atoms = graphene(2, 1, 1.42);
  atoms.positions[1] = atoms.positions[0];
  EXPECT_THROW((void)airebo(atoms), InvalidAtoms);
}

TEST(Airebo, KeepsNeighborsOfAtomsThatMove) {
  for (Atoms atoms : small_disordered_structures()) {
    Airebo kept;
    static_cast<void>(kept.evaluate(atoms));
    // Small steps first, then one beyond every skin, then another box.
    for (const double step : {0.05, 0.05, 0.05, 3.0}) {
      for (std::size_t i = 0; i < atoms.size(); ++i) {
        const auto phase = static_cast<double>(i);
        atoms.positions[i] +=
            step * Eigen::Vector3d(std::sin(phase), std::cos(2.0 * phase), std::sin(3.0 * phase));
      }
      const EnergyForces now = kept.evaluate(atoms);
      const EnergyForces fresh = airebo(atoms);
      EXPECT_NEAR(now.energy, fresh.energy, 1e-10 * (1.0 + std::abs(fresh.energy)));
      EXPECT_LT((now.virial - fresh.virial).norm(), 1e-9 * (1.0 + fresh.virial.norm()));
      for (std::size_t i = 0; i < atoms.size(); ++i) {
        EXPECT_LT((now.forces[i] - fresh.forces[i]).norm(), 1e-8 * (1.0 + fresh.forces[i].norm()));
      }
      kept.forget();
      EXPECT_EQ(kept.evaluate(atoms).energy, fresh.energy);
    }
    // Other elements in the same places.
    for (Species& species : atoms.species) species = Species::carbon;
    EXPECT_NEAR(kept.evaluate(atoms).energy, airebo(atoms).energy, 1e-8);
    atoms.box.cell *= 1.01;
    EXPECT_NEAR(kept.evaluate(atoms).energy, airebo(atoms).energy, 1e-8);
  }
}

}  // namespace
}  // namespace trivalent::potentials
