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
  void compute(const AtomsView& atoms, EnergyForces& result) override {
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
  EXPECT_FALSE(relaxed.held.empty());
  EXPECT_FALSE(relaxed.converged);
  EXPECT_EQ(relaxed.end, RelaxEnd::bonds_held);
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

TEST(Relax, GoesOnWithoutANetworkAsIfNothingHadHappened) {
  RelaxOptions options = {.max_force = 1e-4, .checkpoint_every = 7};
  std::vector<std::pair<RelaxOptions, Atoms>> checkpoints;
  Rebo rebo;
  options.on_checkpoint = [&](const RelaxCheckpoint& state) {
    checkpoints.emplace_back(RelaxOptions{.max_force = 1e-4,
                                          .start = RelaxStart::direct,
                                          .first_step = state.steps,
                                          .first_evaluation = state.evaluations,
                                          .checkpoint_every = 7},
                             state.atoms);
  };
  const auto whole = relax(rough_shell(4), rebo, options);
  ASSERT_GT(checkpoints.size(), 2U);
  for (const auto& [again, atoms] : checkpoints) {
    EXPECT_EQ(relax(atoms, rebo, again).atoms.positions, whole.atoms.positions);
  }
}

double largest_force(const Atoms& atoms) {
  double largest = 0.0;
  for (const Eigen::Vector3d& force : rebo(atoms).forces) largest = std::max(largest, force.norm());
  return largest;
}

// As large as a snapshot at 1500 K and beyond: nearest pairs come as close as 1 Å.
TEST(Relax, BringsRattledStructuresBackWithoutANetwork) {
  const std::vector<Atoms> perfect = {leapfrog_shell(1, 1.42), geodesic_shell(2, 1.42),
                                      graphene(4, 3, 1.42039),
                                      nanotube(Chirality::armchair, 5, 4, 1.42)};
  for (const Atoms& whole : perfect) {
    const double energy = relax_under_rebo(whole, {}).result.energy;
    for (const double deviation : {0.05, 0.1, 0.15}) {
      Atoms rattled = whole;
      displace(rattled, deviation, 5);
      const auto relaxed = relax_under_rebo(rattled, {});
      EXPECT_TRUE(relaxed.converged);
      EXPECT_EQ(relaxed.end, RelaxEnd::at_rest);
      EXPECT_LT(relaxed.result.energy, energy + 1e-4 * static_cast<double>(whole.size()));
      EXPECT_NEAR(relaxed.largest_force, largest_force(relaxed.atoms), 1e-7);
    }
  }
}

// Bonds of hydrogen are shorter than those of carbon: no two hydrogens of benzene may be bonded.
TEST(Relax, FindsBenzene) {
  Atoms benzene;
  for (int k = 0; k < 6; ++k) {
    const double angle = std::numbers::pi / 3.0 * k;
    const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0.1 * (k % 3));
    benzene.positions.emplace_back(1.45 * outward);
    benzene.positions.emplace_back(2.45 * outward);
    benzene.species.push_back(Species::carbon);
    benzene.species.push_back(Species::hydrogen);
  }
  const auto relaxed = relax_under_rebo(benzene, {});
  EXPECT_TRUE(relaxed.converged);
  EXPECT_NEAR(relaxed.result.energy, -59.3096, 1e-4);  // [Brenner2002, Table 12]
}

// Springs may hold bonds; the force that is told is still the potential's.
TEST(Relax, TellsThePotentialsForceAtEveryStep) {
  const auto bonds = bonds_within(geodesic_shell(4, 1.42), 1.8);
  int springs = 0;
  const auto relaxed = relax_under_rebo(
      rough_shell(4), {.bonds = bonds, .on_progress = [&](const RelaxProgress& state) {
                         EXPECT_EQ(state.energy.has_value(), state.stage != RelaxStage::springs);
                         EXPECT_EQ(state.largest_force.has_value(), state.energy.has_value());
                         if (!state.energy) {
                           ++springs;
                         } else if (state.steps % 10 == 0) {
                           EXPECT_NEAR(*state.energy, rebo(state.atoms).energy, 1e-7);
                           EXPECT_NEAR(*state.largest_force / largest_force(state.atoms), 1.0,
                                       1e-6);
                         }
                         return true;
                       }});
  EXPECT_TRUE(relaxed.converged);
  EXPECT_GT(springs, 0);
}

TEST(GuessBonds, AreChemical) {
  Atoms atoms;  // H-C 1.09 Å, H-H 0.9 Å, one more H at 1.3 Å of the first
  atoms.positions = {{0, 0, 0}, {1.09, 0, 0}, {1.09, 0.9, 0}, {0, 1.54, 0}};
  atoms.species = {Species::carbon, Species::hydrogen, Species::hydrogen, Species::carbon};
  const GuessedBonds guess = guess_bonds(atoms);
  ASSERT_EQ(guess.bonds.size(), 2U);  // H-H first, then C-C: hydrogen has one bond only
  EXPECT_EQ(guess.bonds[0].first, 1U);
  EXPECT_EQ(guess.bonds[0].second, 2U);
  EXPECT_EQ(guess.bonds[1].second, 3U);
  EXPECT_EQ(guess.ambiguous.size(), 3U);
}

TEST(GuessBonds, HaveTheLimitsOfRebosCutoffs) {
  EXPECT_DOUBLE_EQ(max_bond_length(Species::carbon, Species::carbon), 1.85);
  EXPECT_DOUBLE_EQ(max_bond_length(Species::carbon, Species::hydrogen), 1.55);
  EXPECT_DOUBLE_EQ(max_bond_length(Species::hydrogen, Species::hydrogen), 1.4);
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
