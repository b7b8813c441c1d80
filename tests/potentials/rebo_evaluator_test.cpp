// The fast evaluation against the plain one, on everything that takes another path through it.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "energy_checks.h"
#include "rebo/evaluator.h"
#include "rebo/parameters.h"
#include "rebo/plain_rebo.h"
#include "rebo/regular_kernel.h"
#include "structures.h"
#include "trivalent/potentials/error.h"
#include "trivalent/potentials/rebo.h"

namespace trivalent::potentials {
namespace {

using testing_support::cube;
using testing_support::diamond;
using testing_support::displace;
using testing_support::graphene;
using testing_support::periodic;
using testing_support::random_hydrocarbon;

EnergyForces plain(const Atoms& atoms) {
  return rebo_detail::plain_rebo(atoms, rebo_detail::brenner_2002);
}

// Rounding: sums in another order, exp to another last digit.
void expect_same(const EnergyForces& fast, const EnergyForces& slow) {
  double scale = 1.0;
  for (const auto& f : slow.forces) scale = std::max(scale, f.norm());
  EXPECT_NEAR(fast.energy, slow.energy, 1e-12 * std::abs(slow.energy) + 1e-12);
  ASSERT_EQ(fast.forces.size(), slow.forces.size());
  for (std::size_t i = 0; i < slow.forces.size(); ++i) {
    EXPECT_NEAR(fast.energies[i], slow.energies[i], 1e-11 * scale) << "atom " << i;
    EXPECT_LT((fast.forces[i] - slow.forces[i]).norm(), 1e-11 * scale) << "atom " << i;
  }
  const double virial_scale = scale * static_cast<double>(slow.forces.size() + 1);
  EXPECT_LT((fast.virial - slow.virial).norm(), 1e-11 * virial_scale);
}

TEST(ReboEvaluator, AgreesWithThePlainOneOnSheetsOfAnyDisorder) {
  for (const double disorder : {0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3}) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      Atoms atoms = graphene(6, 4, 1.42 + 0.04 * seed);
      displace(atoms, disorder, seed);
      expect_same(rebo(atoms), plain(atoms));
    }
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneOnAllInstructionSets) {
  Atoms atoms = testing_support::geodesic_shell(9, 1.42);
  displace(atoms, 0.06, 1);
  const auto [kernels, count] = rebo_detail::usable_regular_kernels();
  for (int k = 0; k < count; ++k) {
    rebo_detail::Evaluator evaluator(rebo_detail::brenner_2002, 0.3, kernels[k]);
    EnergyForces result;
    evaluator.evaluate(atoms, result);
    expect_same(result, plain(atoms));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneOnShells) {
  for (const double disorder : {0.0, 0.05, 0.1}) {
    Atoms atoms = testing_support::geodesic_shell(12, 1.42);
    ASSERT_EQ(atoms.size(), 2880u);
    displace(atoms, disorder, 1);
    expect_same(rebo(atoms), plain(atoms));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneOnCrystals) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Atoms atoms = diamond(2, 3.2 + 0.1 * seed);
    displace(atoms, 0.05 * seed, seed);
    expect_same(rebo(atoms), plain(atoms));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneOnHydrocarbonGases) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const auto box = seed % 2 == 0 ? periodic(cube(7.0)) : cube(7.0);
    const Atoms atoms = random_hydrocarbon(20 + 4 * seed, box, 0.9, seed);
    expect_same(rebo(atoms), plain(atoms));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneInCellsSmallerThanTheCutoff) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Atoms atoms = graphene(1, 1, 1.42);
    atoms.box.cell.col(1) += 0.3 * atoms.box.cell.col(0);
    displace(atoms, 0.05, seed);
    expect_same(rebo(atoms), plain(atoms));
    expect_same(rebo(random_hydrocarbon(2, periodic(cube(1.8)), 0.5, seed)),
                plain(random_hydrocarbon(2, periodic(cube(1.8)), 0.5, seed)));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneAtExactlyTheCutoff) {
  for (const double width : {1.7, 1.8, 2.0, 2.3}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Atoms atoms = random_hydrocarbon(3, periodic(cube(width)), 0.6, seed);
      expect_same(rebo(atoms), plain(atoms));
      Rebo potential;
      expect_same(potential.evaluate(atoms), plain(atoms));
    }
  }
}

// Adatoms, vacancies and a hydrogen make all kinds of borders between regular and other atoms.
TEST(ReboEvaluator, AgreesWithThePlainOneAroundDefects) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Atoms atoms = graphene(8, 5, 1.42);
    displace(atoms, 0.05, seed);
    atoms.positions.erase(atoms.positions.begin() + 31);
    atoms.positions.emplace_back(atoms.positions[70] + Eigen::Vector3d(0.1, 0.2, 1.5));
    atoms.species[100] = Species::hydrogen;
    expect_same(rebo(atoms), plain(atoms));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneForAtomsOutsideTheirCell) {
  Atoms atoms = graphene(6, 4, 1.42);
  displace(atoms, 0.08, 1);
  Atoms moved = atoms;
  for (std::size_t i = 0; i < moved.size(); i += 7) {
    moved.positions[i] += moved.box.cell.col(0) - 3.0 * moved.box.cell.col(1);
  }
  expect_same(rebo(moved), plain(moved));
  EXPECT_NEAR(rebo(moved).energy, rebo(atoms).energy, 1e-9);
}

TEST(ReboEvaluator, GivesTheSameBytesOnAnyNumberOfThreads) {
  Atoms atoms = graphene(40, 40, 1.42);
  displace(atoms, 0.1, 1);
  const auto evaluate_on = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return rebo(atoms);
  };
  const auto one = evaluate_on(1);
  const auto four = evaluate_on(4);
  EXPECT_EQ(one.energy, four.energy);
  EXPECT_EQ(one.energies, four.energies);
  EXPECT_EQ(one.virial, four.virial);
  EXPECT_EQ(one.forces, four.forces);
}

TEST(Rebo, FollowsMovingAtomsAsIfNeighborsWereAlwaysNew) {
  Atoms atoms = graphene(6, 4, 1.42);
  Rebo potential({.skin = 0.3});
  for (unsigned step = 0; step < 30; ++step) {
    displace(atoms, 0.02, step);
    expect_same(potential.evaluate(atoms), plain(atoms));
  }
}

// Sheets of several tiles, regular at first. Within half the skin some atoms tear their bonds and
// come back, elsewhere at every step.
TEST(Rebo, FollowsDefectsThatComeAndGo) {
  Atoms sheet = graphene(40, 30, 1.62);
  displace(sheet, 0.01, 1);
  Rebo potential({.skin = 0.3});
  for (std::size_t step = 0; step < 12; ++step) {
    Atoms atoms = sheet;
    for (std::size_t k = 0; k < step % 4; ++k) {
      atoms.positions[(step * 977 + k * 1511) % atoms.size()] += Eigen::Vector3d(0.1, 0.09, 0.0);
    }
    expect_same(potential.evaluate(atoms), plain(atoms));
  }
}

TEST(ReboEvaluator, AgreesWithThePlainOneWhereTilesMeetDefects) {
  for (std::size_t seed = 0; seed < 6; ++seed) {
    Atoms atoms = graphene(40, 30, 1.42);
    displace(atoms, 0.05, static_cast<unsigned>(seed));
    const std::size_t place = seed * 797 % atoms.size();
    atoms.positions.emplace_back(atoms.positions[place] + Eigen::Vector3d(0.1, 0.2, 1.5));
    atoms.species.push_back(seed % 2 == 0 ? Species::carbon : Species::hydrogen);
    Rebo potential;
    expect_same(potential.evaluate(atoms), plain(atoms));
    expect_same(potential.evaluate(atoms), plain(atoms));
  }
}

TEST(Rebo, FollowsAtomsThatChangeTheirKindNumberOrBox) {
  Rebo potential;
  Atoms atoms = graphene(3, 2, 1.42);
  expect_same(potential.evaluate(atoms), plain(atoms));
  atoms.species[3] = Species::hydrogen;
  expect_same(potential.evaluate(atoms), plain(atoms));
  atoms.box.cell *= 1.01;
  expect_same(potential.evaluate(atoms), plain(atoms));
  atoms.box.periodic[1] = false;
  expect_same(potential.evaluate(atoms), plain(atoms));
  expect_same(potential.evaluate(diamond(2, 3.5)), plain(diamond(2, 3.5)));
  expect_same(potential.evaluate(Atoms{}), plain(Atoms{}));
}

TEST(Rebo, RecoversFromAtomsItCannotEvaluate) {
  Rebo potential;
  const Atoms atoms = graphene(3, 2, 1.42);
  Atoms broken = atoms;
  broken.positions[5][0] = std::nan("");
  expect_same(potential.evaluate(atoms), plain(atoms));
  EXPECT_THROW((void)potential.evaluate(broken), InvalidAtoms);
  expect_same(potential.evaluate(atoms), plain(atoms));
  Atoms collided = atoms;
  collided.positions[1] += 0.95 * (atoms.positions[0] - atoms.positions[1]);
  expect_same(potential.evaluate(collided), plain(collided));
  collided.positions[1] = collided.positions[0];  // a step within the skin
  EXPECT_THROW((void)potential.evaluate(collided), InvalidAtoms);
}

}  // namespace
}  // namespace trivalent::potentials
