#include "trivalent/potentials/relax.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "structures.h"
#include "trivalent/potentials/error.h"
#include "trivalent/potentials/rebo.h"

namespace {

using namespace trivalent::potentials;  // NOLINT(google-build-using-namespace): the unit under test
using trivalent::testing_support::Chirality;
using trivalent::testing_support::displace;
using trivalent::testing_support::geodesic_shell;
using trivalent::testing_support::graphene;
using trivalent::testing_support::leapfrog_shell;
using trivalent::testing_support::nanotube;

RelaxResult relax_under_rebo(Atoms atoms, const RelaxOptions& options) {
  Rebo rebo;
  return relax(std::move(atoms), rebo, options);
}

/// One spring between two atoms, 1.5 Å long.
class Spring : public Potential {
  void compute(const Atoms& atoms, EnergyForces& result) override {
    const Eigen::Vector3d between = atoms.positions[1] - atoms.positions[0];
    const double excess = between.norm() - 1.5;
    result.energy = 10.0 * excess * excess;
    result.forces = {20.0 * excess * between.normalized(), -20.0 * excess * between.normalized()};
    result.energies = {0.5 * result.energy, 0.5 * result.energy};
  }
};

double energy_per_atom(const RelaxResult& result) {
  return result.result.energy / static_cast<double>(result.atoms.size());
}

/// Every bond gets a length of its own, as in the dual of a raw mesh.
Atoms rough_shell(int frequency) {
  Atoms atoms = geodesic_shell(frequency, 1.42);
  displace(atoms, 0.15, 7);
  return atoms;
}

class EveryMinimizer : public testing::TestWithParam<Minimizer> {};

TEST_P(EveryMinimizer, BringsADimerToTheMinimumOfAParabola) {
  Atoms dimer;
  dimer.positions = {{0, 0, 0}, {1.0, 0.5, 0}};
  dimer.species.assign(2, Species::carbon);
  Spring spring;
  const auto relaxed = relax(dimer, spring, {.minimizer = GetParam(), .max_force = 1e-8});
  EXPECT_TRUE(relaxed.converged);
  EXPECT_NEAR((relaxed.atoms.positions[1] - relaxed.atoms.positions[0]).norm(), 1.5, 1e-8);
}

TEST_P(EveryMinimizer, FindsTheEnergyOfC180) {
  const Atoms shell = geodesic_shell(3, 1.42);
  const auto bonds = bonds_within(shell, 1.8);
  const auto relaxed =
      relax_under_rebo(shell, {.minimizer = GetParam(), .max_force = 1e-4, .bonds = bonds});
  EXPECT_TRUE(relaxed.converged);
  // pair_style rebo, minimised by LAMMPS [LAMMPS].
  EXPECT_NEAR(energy_per_atom(relaxed), -7.15564, 1e-5);
}

// Energies of shells and tubes that pair_style rebo, minimized by LAMMPS, is known to give
// [LAMMPS].
TEST(Relax, FindsTheEnergiesOfFullerenes) {
  for (const auto& [frequency, energy] : {std::pair{1, -6.84206}, {2, -7.20509}, {3, -7.29465}}) {
    const Atoms shell = leapfrog_shell(frequency, 1.42);
    const auto bonds = bonds_within(shell, 1.8);
    ASSERT_EQ(2 * bonds.size(), 3 * shell.size());
    const auto relaxed = relax_under_rebo(shell, {.max_force = 1e-4, .bonds = bonds});
    EXPECT_TRUE(relaxed.converged);
    EXPECT_NEAR(energy_per_atom(relaxed), energy, 1e-5) << shell.size();
  }
}

TEST(Relax, FindsTheEnergiesOfTubes) {
  const auto relaxed_energy = [](Chirality chirality, int n) {
    const Atoms tube = nanotube(chirality, n, 4, 1.42);
    const auto relaxed = relax_under_rebo(
        tube,
        {.max_force = 1e-4, .box = BoxPolicy::pressure_free, .bonds = bonds_within(tube, 1.8)});
    EXPECT_TRUE(relaxed.converged);
    return energy_per_atom(relaxed);
  };
  EXPECT_NEAR(relaxed_energy(Chirality::armchair, 5), -7.24617, 1e-5);
  EXPECT_NEAR(relaxed_energy(Chirality::armchair, 10), -7.35586, 1e-5);
  EXPECT_NEAR(relaxed_energy(Chirality::armchair, 20), -7.38506, 1e-5);
  EXPECT_NEAR(relaxed_energy(Chirality::zigzag, 10), -7.28131, 1e-5);
  EXPECT_NEAR(relaxed_energy(Chirality::zigzag, 17), -7.35441, 1e-5);
}

TEST_P(EveryMinimizer, LeavesFixedAtomsWhereTheyAre) {
  const Atoms shell = rough_shell(2);
  const auto bonds = bonds_within(geodesic_shell(2, 1.42), 1.8);
  const auto relaxed = relax_under_rebo(
      shell, {.minimizer = GetParam(), .max_force = 1e-2, .fixed = {3, 17}, .bonds = bonds});
  EXPECT_TRUE(relaxed.converged);
  for (const std::size_t atom : {3U, 17U}) {
    EXPECT_EQ(relaxed.atoms.positions[atom], shell.positions[atom]);
  }
  EXPECT_NE(relaxed.atoms.positions[0], shell.positions[0]);
}

INSTANTIATE_TEST_SUITE_P(Relax, EveryMinimizer, testing::Values(Minimizer::lbfgs, Minimizer::fire),
                         [](const auto& tested) {
                           return tested.param == Minimizer::fire ? "Fire" : "Lbfgs";
                         });

TEST(Relax, FindsGraphenesBondLengthWithAFreeCell) {
  Atoms sheet = graphene(3, 2, 1.47);
  const auto relaxed = relax_under_rebo(
      sheet,
      {.max_force = 1e-5, .box = BoxPolicy::pressure_free, .bonds = bonds_within(sheet, 1.8)});
  EXPECT_TRUE(relaxed.converged);
  EXPECT_NEAR(energy_per_atom(relaxed), -7.394997, 1e-6);
  for (const Bond& bond : bonds_within(relaxed.atoms, 1.8)) {
    EXPECT_NEAR(bond_length(relaxed.atoms, bond), 1.42039, 1e-5);
  }
  EXPECT_EQ(relaxed.atoms.box.cell.col(2), sheet.box.cell.col(2));  // not periodic
}

TEST(Relax, TearsNoBondOfARoughNetwork) {
  const auto bonds = bonds_within(geodesic_shell(6, 1.42), 1.8);
  const Atoms shell = rough_shell(6);
  double shortest = 9.0;
  for (const Bond& bond : bonds) shortest = std::min(shortest, bond_length(shell, bond));
  ASSERT_LT(shortest, 1.0);  // rough indeed
  const auto relaxed = relax_under_rebo(shell, {.bonds = bonds});
  EXPECT_TRUE(relaxed.converged);
  EXPECT_LE(relaxed.largest_force, 1e-3);
  const BondChanges changes = bond_changes(relaxed.atoms, bonds);
  EXPECT_TRUE(changes.broken.empty());
  EXPECT_TRUE(changes.formed.empty());
}

TEST(Relax, EndsWhenTheEnergyHasSettled) {
  const Atoms shell = geodesic_shell(6, 1.42);
  const auto bonds = bonds_within(shell, 1.8);
  const RelaxOptions strict = {.max_force = 1e-9, .max_steps = 1000, .bonds = bonds};
  RelaxOptions settled = strict;
  settled.energy_change = 1e-6;
  const auto whole = relax_under_rebo(shell, strict);
  const auto early = relax_under_rebo(shell, settled);
  EXPECT_TRUE(early.converged);
  EXPECT_GT(early.largest_force, 1e-9);
  EXPECT_LT(early.steps, whole.steps);
  EXPECT_NEAR(energy_per_atom(early), energy_per_atom(whole), 1e-5);
}

TEST(Relax, HoldsBondsThatWantToTear) {
  // A chain whose ends are too far apart for its bonds.
  Atoms chain;
  for (int k = 0; k < 6; ++k) chain.positions.emplace_back(1.84 * k + 0.01 * (k % 2), 0.0, 0.0);
  chain.species.assign(6, Species::carbon);
  const auto bonds = bonds_within(chain, 1.9);
  ASSERT_EQ(bonds.size(), 5U);
  const auto relaxed = relax_under_rebo(chain, {.fixed = {0, 5}, .bonds = bonds});
  EXPECT_TRUE(relaxed.converged);
  EXPECT_FALSE(relaxed.held.empty());
  EXPECT_TRUE(bond_changes(relaxed.atoms, bonds).broken.empty());
  // What is told is the potential's, without the springs.
  EXPECT_NEAR(relaxed.result.energy, rebo(relaxed.atoms).energy, 1e-9);
}

TEST(Relax, GoesOnFromACheckpointAsIfNothingHadHappened) {
  const auto bonds = bonds_within(geodesic_shell(4, 1.42), 1.8);
  RelaxOptions options = {.max_force = 1e-4, .bonds = bonds, .checkpoint_every = 5};
  std::vector<std::pair<RelaxOptions, Atoms>> checkpoints;
  Rebo rebo;
  options.on_checkpoint = [&](const RelaxCheckpoint& state) {
    rebo.forget();
    checkpoints.emplace_back(options, state.atoms);
    auto& again = checkpoints.back().first;
    again.start = RelaxStart::direct;
    again.first_step = state.steps;
    again.first_evaluation = state.evaluations;
    again.on_checkpoint = [&](const RelaxCheckpoint&) { rebo.forget(); };
  };
  const auto whole = relax(rough_shell(4), rebo, options);
  ASSERT_GT(checkpoints.size(), 2U);
  for (const auto& [again, atoms] : checkpoints) {
    const auto resumed = relax(atoms, rebo, again);
    EXPECT_EQ(resumed.atoms.positions, whole.atoms.positions);
    EXPECT_EQ(resumed.result.energy, whole.result.energy);
    EXPECT_EQ(resumed.steps, whole.steps);
    EXPECT_EQ(resumed.evaluations, whole.evaluations);
  }
}

TEST(Relax, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto bonds = bonds_within(geodesic_shell(12, 1.42), 1.8);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return relax_under_rebo(rough_shell(12), {.max_steps = 60, .bonds = bonds});
  };
  EXPECT_EQ(run(1).atoms.positions, run(4).atoms.positions);
}

TEST(Relax, StopsOnRequestAndSaysHowFarItCame) {
  int calls = 0;
  const auto relaxed =
      relax_under_rebo(rough_shell(2), {.on_progress = [&](const RelaxProgress& state) {
                         ++calls;
                         return state.steps < 3;
                       }});
  EXPECT_EQ(relaxed.steps, 3);
  EXPECT_EQ(calls, 4);
  EXPECT_FALSE(relaxed.converged);
}

TEST(Relax, TellsThePotentialsEnergyWhereverItIsStopped) {
  const Atoms shell = rough_shell(4);
  const auto bonds = bonds_within(shell, 1.9);
  const auto stopped =
      relax_under_rebo(shell, {.bonds = bonds, .on_progress = [](const RelaxProgress& state) {
                                 EXPECT_EQ(state.stage, RelaxStage::springs);
                                 return state.steps < 2;
                               }});
  EXPECT_NEAR(stopped.result.energy, rebo(stopped.atoms).energy, 1e-8);
}

TEST(Relax, RefusesWhatMakesNoSense) {
  const Atoms shell = geodesic_shell(2, 1.42);
  const auto with = [&](const RelaxOptions& options) {
    return [&shell, options] { (void)relax_under_rebo(shell, options); };
  };
  EXPECT_THROW(with({.max_force = 0.0})(), InvalidOption);
  EXPECT_THROW(with({.max_move = -1.0})(), InvalidOption);
  EXPECT_THROW(with({.max_steps = -1})(), InvalidOption);
  EXPECT_THROW(with({.checkpoint_every = 0})(), InvalidOption);
  EXPECT_THROW(with({.energy_change = -1.0})(), InvalidOption);
  EXPECT_THROW(with({.fixed = {80}})(), InvalidAtoms);
  EXPECT_THROW(with({.bonds = {{0, 80, {0, 0, 0}}}})(), InvalidAtoms);
  Atoms lost = shell;
  lost.positions[4].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)relax_under_rebo(lost, {}), InvalidAtoms);
}

TEST(BondChanges, NamesWhatBrokeAndWhatFormed) {
  Atoms square;
  square.positions = {{0, 0, 0}, {1.4, 0, 0}, {1.4, 1.4, 0}, {0, 2.1, 0}};
  square.species.assign(4, Species::carbon);
  const std::vector<Bond> bonds = {{1, 0}, {3, 2}, {0, 3}};
  const BondChanges changes = bond_changes(square, bonds);
  ASSERT_EQ(changes.broken.size(), 1U);
  EXPECT_EQ(changes.broken[0].first, 0U);
  EXPECT_EQ(changes.broken[0].second, 3U);
  ASSERT_EQ(changes.formed.size(), 2U);
  EXPECT_EQ(changes.formed[0].second, 2U);  // 0-2 across
  EXPECT_EQ(changes.formed[1].first, 1U);
  EXPECT_EQ(changes.coordinations, (std::vector<int>{2, 2, 3, 1}));
}

TEST(BondsBetween, TakesTheNearestImage) {
  const Atoms sheet = graphene(3, 2, 1.42);
  std::vector<std::array<int, 2>> pairs;
  const auto bonds = bonds_within(sheet, 1.8);
  for (const Bond& bond : bonds) {
    pairs.push_back({static_cast<int>(bond.first), static_cast<int>(bond.second)});
  }
  for (const Bond& bond : bonds_between(sheet, pairs)) {
    EXPECT_NEAR(bond_length(sheet, bond), 1.42, 1e-12);
  }
  const std::vector<std::array<int, 2>> wrong = {{0, 24}};
  EXPECT_THROW((void)bonds_between(sheet, wrong), InvalidAtoms);
}

}  // namespace
