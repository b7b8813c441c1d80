#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "small_meshes.h"
#include "temporary_folder.h"
#include "trivalent/dual/bonding.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/potentials/bonds.h"
#include "xyz_text.h"

// The columns bonded_atoms and bonded_images of extended XYZ.
namespace trivalent::dual {
namespace {

using potentials::Species;
using testing_support::TemporaryFolder;

/// Bonds with their atoms and the bonds in order, to be compared.
std::vector<std::array<std::int64_t, 5>> sorted(const std::vector<potentials::Bond>& bonds) {
  std::vector<std::array<std::int64_t, 5>> entries;
  for (const auto& [first, second, image] : bonds) {
    const std::array<std::int64_t, 5> there = {first, second, image[0], image[1], image[2]};
    const std::array<std::int64_t, 5> back = {second, first, -image[0], -image[1], -image[2]};
    entries.push_back(std::min(there, back));
  }
  std::ranges::sort(entries);
  return entries;
}

TEST(XyzNetwork, KeepsTheNetwork) {
  const Structure network = build_dual(testing_support::icosahedron());
  const Structure copy = xyz_file_of(xyz_text_of(network)).structure;
  ASSERT_EQ(copy.bonds.size(), network.bonds.size());
  EXPECT_EQ(sorted(copy.bonds), sorted(network.bonds));
}

/// Two atoms of graphene, bonded to three images of each other.
Structure graphene_cell() {
  Structure cell;
  cell.atoms.positions = {{0, 0, 8}, {0, 1.42, 8}};
  cell.atoms.species = {Species::carbon, Species::carbon};
  cell.atoms.box.cell.col(0) = Eigen::Vector3d(2.46, 0, 0);
  cell.atoms.box.cell.col(1) = Eigen::Vector3d(-1.23, 2.13, 0);
  cell.atoms.box.cell.col(2) = Eigen::Vector3d(0, 0, 16);
  cell.atoms.box.periodic = {true, true, false};
  cell.bonds = find_bonds(cell.atoms);
  return cell;
}

TEST(XyzNetwork, KeepsTheImagesOfBonds) {
  const Structure cell = graphene_cell();
  ASSERT_EQ(cell.bonds.size(), 3u);
  EXPECT_EQ(sorted(xyz_file_of(xyz_text_of(cell)).structure.bonds), sorted(cell.bonds));
}

TEST(XyzNetwork, MendsImagesOfAtomsThatWereWrapped) {
  Structure cell = graphene_cell();
  // A cell of its own for each bond, so that the nearest image is the bonded one.
  cell.atoms.box.cell *= 4.0;
  cell.bonds = {{.first = 0, .second = 1}};
  std::string text = xyz_text_of(cell);
  const std::string second = "C 0.0000000000 1.4200000000 8.0000000000";
  const std::size_t at = text.find(second);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, second.size(), "C 9.8400000000 1.4200000000 8.0000000000");
  const auto [structure, notes] = xyz_file_of(text);
  ASSERT_EQ(structure.bonds.size(), 1u);
  EXPECT_NEAR(potentials::bond_length(structure.atoms, structure.bonds[0]), 1.42, 1e-12);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(XyzNetwork, LeavesOutBondsThatDoNotMatch) {
  const std::string head = "3\nProperties=species:S:1:pos:R:3:bonded_atoms:I:2\n";
  for (const std::string rows :
       {"C 0 0 0 1 -1\nC 1 0 0 2 -1\nC 2 0 0 1 -1\n", "C 0 0 0 1 -1\nC 1 0 0 0 7\nC 2 0 0 -1 -1\n",
        "C 0 0 0 0 -1\nC 1 0 0 -1 -1\nC 2 0 0 -1 -1\n"}) {
    const auto [structure, notes] = xyz_file_of(head + rows);
    EXPECT_EQ(structure.atoms.size(), 3u);
    EXPECT_TRUE(structure.bonds.empty());
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("the bonds of the file are not used"), std::string::npos);
  }
}

TEST(XyzNetwork, LeavesOutBondsToImagesBeyondCounting) {
  const auto [structure, notes] = xyz_file_of(
      "1\nLattice=\"2 0 0 0 2 0 0 0 2\" "
      "Properties=species:S:1:pos:R:3:bonded_atoms:I:1:bonded_images:I:3\n"
      "C 0 0 0 0 -2147483648 0 0\n");
  EXPECT_TRUE(structure.bonds.empty());
  EXPECT_EQ(notes.size(), 1u);
}

}  // namespace
}  // namespace trivalent::dual
