#include "trivalent/dual/hydrogen.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "small_meshes.h"
#include "small_structures.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/network_checks.h"

namespace trivalent::dual {
namespace {

Eigen::Vector3d along(const Structure& network, int from, int to) {
  return network.atoms.positions[static_cast<std::size_t>(to)] -
         network.atoms.positions[static_cast<std::size_t>(from)];
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

constexpr double third_of_a_turn = 2.0 * 3.14159265358979323846 / 3.0;

TEST(CapWithHydrogen, GivesEveryCarbonAtomThreeBonds) {
  Structure network = build_dual(testing_support::flat_sheet(6, 5, 2.46));
  const std::size_t carbons = network.atoms.positions.size();
  const HydrogenCaps caps = cap_with_hydrogen(network);
  EXPECT_GT(caps.hydrogens, 0);
  EXPECT_EQ(caps.bare_atoms, 0);
  EXPECT_EQ(network.atoms.positions.size(), carbons + static_cast<std::size_t>(caps.hydrogens));
  const std::vector<int> bonds = coordinations(network);
  for (std::size_t i = 0; i < bonds.size(); ++i) EXPECT_EQ(bonds[i], i < carbons ? 3 : 1);
}

TEST(CapWithHydrogen, KeepsToThePlaneAndTheLength) {
  // Equilateral triangles: all bonds meet at 120°, those to hydrogen too.
  Structure network = build_dual(testing_support::flat_sheet(6, 5, 2.46));
  const auto carbons = static_cast<int>(network.atoms.positions.size());
  cap_with_hydrogen(network);
  for (const auto& [carbon, hydrogen] : drawable_bonds(network)) {
    if (hydrogen < carbons) continue;
    const Eigen::Vector3d bond = along(network, carbon, hydrogen);
    EXPECT_NEAR(bond.norm(), 1.09, 1e-12);
    EXPECT_NEAR(bond.z(), 0.0, 1e-12);
    for (const auto& [first, second] : drawable_bonds(network)) {
      if (first != carbon && second != carbon) continue;
      const int other = first == carbon ? second : first;
      if (other == hydrogen) continue;
      EXPECT_NEAR(angle(bond, along(network, carbon, other)), third_of_a_turn, 1e-9);
    }
  }
}

TEST(CapWithHydrogen, KnowsWhichAtomsAreHydrogen) {
  Structure network = build_dual(testing_support::flat_sheet(3, 3, 2.46));
  const std::size_t carbons = network.atoms.positions.size();
  cap_with_hydrogen(network);
  const potentials::Atoms atoms = network.atoms;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    EXPECT_EQ(atoms.species[i],
              i < carbons ? potentials::Species::carbon : potentials::Species::hydrogen);
  }
}

TEST(CapWithHydrogen, TakesBondsInOneLine) {
  Structure chain = {.atoms = testing_support::carbon_at({{0, 0, 0}, {1.4, 0, 0}, {2.8, 0, 0}}),
                     .bonds = {{0, 1}, {1, 2}}};
  EXPECT_EQ(cap_with_hydrogen(chain).hydrogens, 5);
  for (const auto& position : chain.atoms.positions) EXPECT_TRUE(position.allFinite());
  for (const auto& [carbon, hydrogen] : drawable_bonds(chain)) {
    if (hydrogen < 3) continue;
    EXPECT_NEAR(along(chain, carbon, hydrogen).norm(), 1.09, 1e-12);
  }
}

TEST(CapWithHydrogen, LeavesClosedNetworksAndBareAtomsAlone) {
  Structure lone = {.atoms = testing_support::carbon_at({{0, 0, 0}})};
  EXPECT_EQ(cap_with_hydrogen(lone).bare_atoms, 1);
  EXPECT_EQ(lone.atoms.positions.size(), 1u);
}

TEST(WithoutHydrogen, UndoesTheCapsWhereverTheyAre) {
  const Structure bare = build_dual(testing_support::flat_sheet(4, 3, 2.46));
  Structure capped = bare;
  cap_with_hydrogen(capped);
  // Hydrogen first: nothing may depend on its place.
  const auto n_atoms = static_cast<std::uint32_t>(capped.atoms.size());
  std::ranges::reverse(capped.atoms.positions);
  std::ranges::reverse(capped.atoms.species);
  for (auto& bond : capped.bonds) {
    bond = {n_atoms - 1 - bond.first, n_atoms - 1 - bond.second};
  }
  for (Ring& ring : capped.rings) {
    for (int& atom : ring.atoms) atom = static_cast<int>(n_atoms) - 1 - atom;
  }
  const Structure carbon = without_hydrogen(capped);
  EXPECT_FALSE(has_hydrogen(carbon.atoms));
  const NetworkReport report = check_network(carbon);
  const NetworkReport expected = check_network(bare);
  EXPECT_EQ(report.atoms, expected.atoms);
  EXPECT_EQ(report.coordinations, expected.coordinations);
  EXPECT_EQ(report.ring_sizes, expected.ring_sizes);
  EXPECT_EQ(report.bond_max, expected.bond_max);
}

TEST(CapWithHydrogen, ThrowsOnASecondTime) {
  Structure network = build_dual(testing_support::flat_sheet(3, 3, 2.46));
  cap_with_hydrogen(network);
  EXPECT_THROW(cap_with_hydrogen(network), InvalidNetwork);
}

}  // namespace
}  // namespace trivalent::dual
