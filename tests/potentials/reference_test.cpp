// Everything in tests/data/lammps, which scripts/make_references.sh made with LAMMPS.

#include <gtest/gtest.h>

#include <cmath>

#include "energy_checks.h"
#include "reference_structure.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/rebo.h"

namespace trivalent::potentials {
namespace {

using testing_support::ReferenceStructure;

const std::string folder = TRIVALENT_TEST_DATA "/lammps";

template <typename Potential>
void expect_all_agree(const std::string& style, std::size_t fewest, const Potential& potential) {
  const auto references = testing_support::read_references(folder, style);
  EXPECT_GE(references.size(), fewest) << "references are missing";
  for (const ReferenceStructure& reference : references) {
    const auto off = testing_support::deviation(reference, potential(reference.atoms),
                                                testing_support::tolerance_of(reference));
    EXPECT_LE(off.energy, 1.0) << reference.name;
    EXPECT_LE(off.energies, 1.0) << reference.name;
    EXPECT_LE(off.forces, 1.0) << reference.name;
    EXPECT_LE(off.virial, 1.0) << reference.name;
  }
}

TEST(Rebo, AgreesWithLammps) {
  expect_all_agree("rebo", 70, [](const Atoms& atoms) { return rebo(atoms); });
}

// The structures where LAMMPS's forces are not the slope of its energy to 1e-7: ours are.
TEST(Rebo, HasExactForcesWhereLammpsDropsTerms) {
  for (const std::string name : {"diamond", "amorphous"}) {
    const auto reference =
        testing_support::read_reference(folder + "/" + name + "_dropped_terms.rebo.extxyz");
    testing_support::expect_forces_match_energy(
        reference.atoms, [](const Atoms& atoms) { return rebo(atoms); }, 2e-8);
  }
}

TEST(Airebo, AgreesWithLammps) {
  expect_all_agree("airebo11", 60, [](const Atoms& atoms) { return airebo(atoms); });
}

TEST(LennardJones, AgreesWithLammps) {
  expect_all_agree("ljcut", 60, [](const Atoms& atoms) { return lennard_jones(atoms); });
}

double energy_per_atom(const std::string& name) {
  const auto reference = testing_support::read_reference(folder + "/" + name + ".rebo.extxyz");
  return rebo(reference.atoms).energy / static_cast<double>(reference.atoms.size());
}

// Relaxed energies as LAMMPS users find them, to the five digits they are usually given with.
TEST(Rebo, GivesTheKnownEnergiesOfFullerenesAndTubes) {
  constexpr double digits = 1e-5;
  EXPECT_NEAR(energy_per_atom("relaxed_C60"), -6.84206, digits);
  EXPECT_NEAR(energy_per_atom("relaxed_C180"), -7.15564, digits);
  EXPECT_NEAR(energy_per_atom("relaxed_C240"), -7.20509, digits);
  EXPECT_NEAR(energy_per_atom("relaxed_C540"), -7.29465, digits);
  EXPECT_NEAR(energy_per_atom("relaxed_tube_5_5"), -7.24617, digits);
  EXPECT_NEAR(energy_per_atom("relaxed_tube_10_0"), -7.28131, digits);
  EXPECT_NEAR(energy_per_atom("relaxed_tube_10_10"), -7.35586, digits);
}

// 5.12 eV for 960 atoms in a box that stays, 30 x 8 cells of four atoms, buckled. How sheets buckle
// and their shape decide about a tenth: 5.13 to 5.20 eV in other boxes of 960 atoms, 5.30 to 5.37
// eV flat.
TEST(Rebo, GivesTheKnownEnergyOfAStoneWalesDefect) {
  constexpr double graphene = -7.39499725165;
  const double cost = 960.0 * (energy_per_atom("relaxed_stone_wales_960") - graphene);
  EXPECT_NEAR(cost, 5.12, 0.005);
}

}  // namespace
}  // namespace trivalent::potentials
