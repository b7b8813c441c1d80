#include "trivalent/dual/shell_checks.h"

#include <gtest/gtest.h>

#include "small_meshes.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/dual_size.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/hydrogen.h"

namespace trivalent::dual {
namespace {

ShellReport check(const potentials::Atoms& atoms) {
  const Bonding bonding = bonding_of(atoms, find_bonds(atoms));
  return check_shell(atoms, bonding, find_rings(bonding));
}

potentials::Atoms dual_atoms(remesh::TriMesh mesh) {
  remesh::scale(mesh, scale_for_size(mesh, MeanBond{1.42}));
  return build_dual(mesh).atoms;
}

TEST(CheckShell, KnowsTheDodecahedron) {
  const ShellReport report = check(dual_atoms(testing_support::icosahedron()));
  EXPECT_EQ(report.atoms, 20);
  EXPECT_EQ(report.bonds, 30);
  EXPECT_EQ(report.pieces, 1);
  EXPECT_EQ(report.ring_sizes, (std::map<int, int>{{5, 12}}));
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.euler_characteristic(), 2);
  EXPECT_NEAR(report.shortest_bond->distance, 1.42, 1e-9);
  EXPECT_NEAR(report.longest_bond->distance, 1.42, 1e-9);
  EXPECT_NEAR(report.smallest_angle->angle, 108.0, 1e-9);
  EXPECT_NEAR(report.largest_angle->angle, 108.0, 1e-9);
  // The diagonal of a pentagon.
  EXPECT_NEAR(report.closest_non_bonded->distance, 1.42 * 0.5 * (1.0 + std::sqrt(5.0)), 1e-9);
}

TEST(CheckShell, KnowsTheEulerCharacteristicOfATorus) {
  // The bonds are those of the mesh: too long and too short for carbon.
  const Structure network = build_dual(testing_support::torus(24, 9));
  const Bonding bonding = bonding_of(network);
  const ShellReport report = check_shell(network.atoms, bonding, find_rings(bonding));
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.euler_characteristic(), 0);
}

TEST(CheckShell, SeesBondsAndRingsAcrossBoundaries) {
  const ShellReport report = check(graphene_cell());
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.euler_characteristic(), 0);
  EXPECT_NEAR(report.largest_angle->angle, 120.0, 1e-6);
  EXPECT_NEAR(report.closest_non_bonded->distance, std::sqrt(3.0) * graphene_bond, 1e-6);
}

TEST(CheckShell, NamesAtomsWithoutThreeBonds) {
  const Structure sheet = build_dual(testing_support::flat_sheet(7, 5, 2.46));
  const ShellReport report = check(sheet.atoms);
  EXPECT_FALSE(report.is_closed());
  EXPECT_FALSE(report.odd_atoms.empty());
  const std::size_t n_odd = report.odd_atoms.size();
  int not_three = 0;
  for (const auto& [bonds, atoms] : report.coordinations) not_three += bonds == 3 ? 0 : atoms;
  EXPECT_EQ(n_odd, static_cast<std::size_t>(not_three));
}

TEST(CheckShell, IsContentWithCappedEdges) {
  Structure sheet = build_dual(testing_support::flat_sheet(7, 5, 2.46));
  static_cast<void>(cap_with_hydrogen(sheet));
  const ShellReport report = check(sheet.atoms);
  for (const int atom : report.odd_atoms) {
    // Only carbon that had a single bond may still lack one.
    EXPECT_EQ(sheet.atoms.species[static_cast<std::size_t>(atom)], potentials::Species::carbon);
  }
  EXPECT_GT(report.shortest_bond->distance, 1.4);  // not that of C-H
}

TEST(CheckShell, CountsPieces) {
  potentials::Atoms atoms = dual_atoms(testing_support::icosahedron());
  const potentials::Atoms one = atoms;
  for (const Eigen::Vector3d& x : one.positions) {
    atoms.positions.emplace_back(x + Eigen::Vector3d(50.0, 0.0, 0.0));
    atoms.species.push_back(potentials::Species::carbon);
  }
  const ShellReport report = check(atoms);
  EXPECT_EQ(report.pieces, 2);
  EXPECT_EQ(report.euler_characteristic(), 4);
}

}  // namespace
}  // namespace trivalent::dual
