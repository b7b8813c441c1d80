#include "trivalent/dual/network_checks.h"

#include <gtest/gtest.h>

#include "small_meshes.h"
#include "small_structures.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

using testing_support::flat_sheet;
using testing_support::icosahedron;
using testing_support::torus;

TEST(CheckNetwork, FindsSixTimesTheEulerCharacteristicOnASphere) {
  const NetworkReport report = check_network(build_dual(icosahedron()));
  EXPECT_EQ(report.ring_excess, 6 * 2);
  EXPECT_TRUE(report.is_trivalent());
  EXPECT_EQ(report.ring_sizes, (std::map<int, int>{{5, 12}}));
  EXPECT_EQ(report.hexagon_fraction, 0.0);
}

TEST(CheckNetwork, FindsSixTimesTheEulerCharacteristicOnATorus) {
  const NetworkReport report = check_network(build_dual(torus(12, 6)));
  EXPECT_EQ(report.ring_excess, 0);
  EXPECT_TRUE(report.is_trivalent());
  EXPECT_EQ(report.hexagon_fraction, 1.0);
  EXPECT_EQ(report.bonds * 2, report.atoms * 3);
}

TEST(CheckNetwork, MeasuresBondLengths) {
  const Structure network = {.atoms = testing_support::carbon_at({{0, 0, 0}, {1, 0, 0}, {1, 3, 0}}),
                             .bonds = {{0, 1}, {1, 2}}};
  const NetworkReport report = check_network(network);
  EXPECT_EQ(report.bond_mean, 2.0);
  EXPECT_EQ(report.bond_spread, 1.0);
  EXPECT_EQ(report.bond_min, 1.0);
  EXPECT_EQ(report.bond_max, 3.0);
  EXPECT_EQ(report.coordinations, (std::map<int, int>{{1, 2}, {2, 1}}));
}

TEST(CheckNetwork, MeasuresBondsAcrossPeriodicBoundaries) {
  Structure network = {.atoms = testing_support::carbon_at({{0, 0, 0}, {4, 0, 0}}),
                       .bonds = {{0, 1, {-1, 0, 0}}}};
  network.atoms.box.cell.diagonal() = Eigen::Vector3d(5, 5, 5);
  network.atoms.box.periodic = {true, true, true};
  EXPECT_EQ(check_network(network).bond_max, 1.0);
  // A bond to the atom's own image is one.
  network.bonds = {{0, 0, {1, 0, 0}}};
  EXPECT_EQ(check_network(network).bond_max, 5.0);
}

TEST(CheckNetwork, ThrowsOnABondToAMissingAtom) {
  const Structure network = {.atoms = testing_support::carbon_at({{0, 0, 0}, {1, 0, 0}}),
                             .bonds = {{0, 2}}};
  EXPECT_THROW(static_cast<void>(check_network(network)), InvalidNetwork);
}

TEST(CheckNetwork, ThrowsOnABondOfAnAtomToItself) {
  const Structure network = {.atoms = testing_support::carbon_at({{0, 0, 0}, {1, 0, 0}}),
                             .bonds = {{1, 1}}};
  EXPECT_THROW(static_cast<void>(check_network(network)), InvalidNetwork);
}

TEST(CheckNetwork, ThrowsOnARingWithAMissingAtom) {
  const Structure network = {.atoms = testing_support::carbon_at({{0, 0, 0}}),
                             .rings = {{{0, -1, 0}}}};
  EXPECT_THROW(static_cast<void>(check_network(network)), InvalidNetwork);
}

TEST(RingSizesAtAtoms, GivesThreeRingsToEveryAtomOfAClosedShell) {
  for (const auto& sizes : ring_sizes_at_atoms(build_dual(icosahedron()))) {
    EXPECT_EQ(sizes, (std::array<int, 3>{5, 5, 5}));
  }
}

TEST(RingSizesAtAtoms, LeavesZerosWhereTheEdgeCutsRings) {
  const auto sizes = ring_sizes_at_atoms(build_dual(flat_sheet(2, 2, 1.0)));
  EXPECT_EQ(sizes.front(), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(sizes[1], (std::array<int, 3>{6, 0, 0}));
}

TEST(RingSizesAtAtoms, ThrowsOnAnAtomInFourRings) {
  const Structure network = {.atoms = testing_support::carbon_at({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                             .rings = std::vector(4, Ring{{0, 1, 2}})};
  EXPECT_THROW(static_cast<void>(ring_sizes_at_atoms(network)), InvalidNetwork);
}

}  // namespace
}  // namespace trivalent::dual
