#include "trivalent/view/atom_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_meshes.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/view/shell_state.h"

namespace trivalent::dual {
namespace {

TEST(PyramidalizationMap, IsZeroInGraphene) {
  for (const double angle :
       pyramidalization_map(bonding_of(graphene_cell(), find_bonds(graphene_cell()))).values) {
    EXPECT_NEAR(angle, 0.0, 1e-9);
  }
}

TEST(PyramidalizationMap, IsThatOfTheDodecahedronInC20) {
  // The three bonds of a corner have 108° between them; an axis at angle a to all three then has
  // 1 - cos 108° = 3/2 sin² a.
  const double degree = std::numbers::pi / 180.0;
  const double sine = std::sqrt((1.0 - std::cos(108.0 * degree)) * 2.0 / 3.0);
  const double expected = 90.0 - std::asin(sine) / degree;  // 20.9°
  const Bonding bonding = bonding_of(build_dual(testing_support::icosahedron()));
  for (const double angle : pyramidalization_map(bonding).values) {
    EXPECT_NEAR(angle, expected, 1e-9);
  }
}

TEST(PyramidalizationMap, HasNoValueWithoutThreeBonds) {
  const Structure network = build_dual(testing_support::flat_sheet(3, 3, 2.46));
  const Bonding bonding = bonding_of(network);
  const AtomMap map = pyramidalization_map(bonding);
  for (std::size_t i = 0; i < bonding.size(); ++i) {
    EXPECT_EQ(std::isnan(map.values[i]), bonding[i].size() != 3);
  }
}

TEST(BondStrainMap, IsTheStretchOfAScaledSheet) {
  const potentials::Atoms cell = graphene_cell(1.05 * 1.42);
  const AtomMap map = bond_strain_map(bonding_of(cell, find_bonds(cell)), cell.species, 1.42);
  for (const double strain : map.values) EXPECT_NEAR(strain, 5.0, 1e-9);
  EXPECT_NEAR(map.scale.middle(), 0.0, 1e-12);
}

TEST(RingSizeMap, ShowsTheOddestRing) {
  const AtomMap map =
      ring_size_map({{6, 6, 6}, {6, 6, 5}, {7, 6, 5}, {8, 6, 5}, {6, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(map.values, (std::vector<double>{6, 5, 7, 8, 6, 0}));
  EXPECT_EQ(map.color(0), category_color(map.categories, 6));
  EXPECT_EQ(category_color(map.categories, 11), category_color(map.categories, 8));
  EXPECT_EQ(category_color(map.categories, 3), category_color(map.categories, 4));
  EXPECT_NE(category_color(map.categories, 0), category_color(map.categories, 4));
}

TEST(DisplacementMap, MeasuresHowFarAtomsMoved) {
  const std::vector<Eigen::Vector3d> from = {{0, 0, 0}, {1, 1, 1}};
  const std::vector<Eigen::Vector3d> to = {{3, 0, 4}, {1, 1, 1}};
  EXPECT_EQ(displacement_map(from, to).values, (std::vector<double>{5.0, 0.0}));
  EXPECT_THROW(static_cast<void>(displacement_map(from, std::vector<Eigen::Vector3d>(3))),
               InvalidNetwork);
}

TEST(AtomMap, IsGreyWithoutAValue) {
  const AtomMap map = distance_map("d", "distance", {std::nan(""), 1.0});
  EXPECT_EQ(map.color(0)[0], map.color(0)[2]);
  EXPECT_NE(map.color(1), map.color(0));
}

TEST(ShellState, SaysTheSameOfAtomsAndOfTheNetworkTheyCameFrom) {
  const Structure network = build_dual(testing_support::flat_sheet(9, 7, 2.46));
  const ShellState known = shell_state("known", network);
  const ShellState found = shell_state("found", {.atoms = known.structure.atoms});
  EXPECT_EQ(found.ring_sizes, known.ring_sizes);
  EXPECT_EQ(found.rings_at_atoms, known.rings_at_atoms);
  EXPECT_EQ(found.find("coordination")->values, known.find("coordination")->values);
  EXPECT_EQ(found.find("energy"), nullptr);
}

TEST(AddEnergies, KeepsHydrogenOutOfTheScales) {
  potentials::Atoms atoms = {.positions = {{0, 0, 0}, {1.4, 0, 0}, {-1.1, 0, 0}},
                             .species = {potentials::Species::carbon, potentials::Species::carbon,
                                         potentials::Species::hydrogen},
                             .box = {}};
  ShellState state = shell_state("C2H", {.atoms = atoms});
  add_energies(state, std::vector<double>{-7.0, -6.5, -2.0}, -7.0);
  EXPECT_EQ(state.find("energy")->values[2], -2.0);
  EXPECT_EQ(state.find("energy")->scale.high, -6.5);
  EXPECT_TRUE(std::isnan(state.find("excess_energy")->values[2]));
  EXPECT_TRUE(std::isnan(state.find("bond_strain")->values[2]));
}

TEST(AddEnergies, ThrowsUnlessThereIsOnePerAtom) {
  ShellState state = shell_state("C20", build_dual(testing_support::icosahedron()));
  EXPECT_THROW(add_energies(state, std::vector<double>(19), 0.0), InvalidNetwork);
  add_energies(state, std::vector<double>(20, -6.0), -7.0);
  EXPECT_EQ(state.maps.front().name, "energy");
  EXPECT_EQ(state.find("excess_energy")->values.front(), 1.0);
}

}  // namespace
}  // namespace trivalent::dual
