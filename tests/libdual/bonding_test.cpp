#include "trivalent/dual/bonding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "small_meshes.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/dual_size.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/potentials/rebo.h"

namespace trivalent::dual {
namespace {

/// A ring in the same words wherever it begins and whichever way it runs.
std::vector<int> sorted(std::vector<int> ring) {
  std::sort(ring.begin(), ring.end());
  return ring;
}

std::vector<std::vector<int>> as_sets(const std::vector<Ring>& rings) {
  std::vector<std::vector<int>> sets;
  for (const Ring& ring : rings) sets.push_back(sorted(ring.atoms));
  std::sort(sets.begin(), sets.end());
  return sets;
}

Bonding bonding_by_distance(const potentials::Atoms& atoms) {
  return bonding_of(atoms, find_bonds(atoms));
}

std::vector<std::vector<int>> found_sets(const Bonding& bonding) {
  return as_sets(find_rings(bonding));
}

remesh::TriMesh with_bond(remesh::TriMesh mesh) {
  remesh::scale(mesh, scale_for_size(mesh, MeanBond{1.42}));
  return mesh;
}

TEST(FindRings, GivesTheDualOfAMeshItsRingsBack) {
  for (const remesh::TriMesh& mesh : {testing_support::icosahedron(), testing_support::torus(24, 9),
                                      testing_support::flat_sheet(7, 5, 2.46)}) {
    const Structure network = build_dual(mesh);
    EXPECT_EQ(found_sets(bonding_of(network)), as_sets(network.rings));
  }
}

TEST(FindRings, SeesOddRingsAmongHexagons) {
  // A flipped edge of a flat sheet is a Stone-Wales defect: two pentagons, two heptagons.
  remesh::TriMesh mesh = testing_support::flat_sheet(8, 8, 2.46);
  for (const auto edge : mesh.edges()) {
    const auto across = [](const auto& half) { return half.next().to().valence() == 6; };
    const bool is_inside = edge.v0().valence() == 6 && edge.v1().valence() == 6 &&
                           across(edge.h0()) && across(edge.h1());
    if (!is_inside) continue;
    mesh.flip(edge);
    break;
  }
  const Structure network = build_dual(mesh);
  const auto sizes = check_network(network).ring_sizes;
  ASSERT_EQ(sizes.at(5), 2);
  ASSERT_EQ(sizes.at(7), 2);
  EXPECT_EQ(found_sets(bonding_of(network)), as_sets(network.rings));
}

TEST(FindRings, LeavesAtomsOfFourBondsOut) {
  // A cube whose corner 0 has a fourth bond: the three faces away from it remain.
  Structure cube;
  for (int i = 0; i < 8; ++i) cube.atoms.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) {
      if ((i & bit) != 0) continue;
      cube.bonds.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i | bit)});
    }
  }
  EXPECT_EQ(find_rings(bonding_of(cube)).size(), 6u);
  cube.atoms.positions.emplace_back(-1, -1, -1);
  cube.bonds.push_back({0, 8});
  const auto rings = find_rings(bonding_of(cube));
  for (const Ring& ring : rings) {
    EXPECT_EQ(std::count(ring.atoms.begin(), ring.atoms.end(), 0), 0);
  }
  EXPECT_GE(rings.size(), 3u);
}

TEST(FindRings, CountsRingsAcrossPeriodicBoundaries) {
  // Four atoms and two rings a cell; every ring leaves a cell this small.
  Structure cell = {.atoms = graphene_cell()};
  add_missing_network(cell);
  const Bonding bonding = bonding_of(cell);
  EXPECT_EQ(coordinations(bonding), std::vector<int>(4, 3));
  ASSERT_EQ(cell.rings.size(), 2u);
  for (const Ring& ring : cell.rings) {
    EXPECT_EQ(ring.atoms.size(), 6u);
    EXPECT_FALSE(ring.images.empty());
  }
  EXPECT_TRUE(drawable_rings(cell).empty());
  EXPECT_LT(drawable_bonds(cell).size(), cell.bonds.size());
  for (const auto& ends : bonding) {
    for (const BondEnd& end : ends) EXPECT_NEAR(end.separation.norm(), graphene_bond, 1e-12);
  }
}

TEST(DrawingOf, CompletesBondsAndRingsByImages) {
  Structure cell = {.atoms = graphene_cell()};
  add_missing_network(cell);
  const Drawing drawing = drawing_of(cell);
  EXPECT_EQ(drawing.positions.size(), 4u + drawing.images.size());
  ASSERT_EQ(drawing.bonds.size(), cell.bonds.size());
  for (const auto& [first, second] : drawing.bonds) {
    EXPECT_NEAR((drawing.positions[first] - drawing.positions[second]).norm(), graphene_bond,
                1e-12);
  }
  ASSERT_EQ(drawing.rings.size(), cell.rings.size());
  for (std::size_t k = 0; k < drawing.rings.size(); ++k) {
    const std::vector<int>& places = drawing.rings[k];
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(drawing.atom(places[i]), cell.rings[k].atoms[i]);
      // A flat regular hexagon: its corners lie twice a bond from those opposite.
      EXPECT_NEAR((drawing.positions[places[i]] - drawing.positions[places[(i + 3) % 6]]).norm(),
                  2.0 * graphene_bond, 1e-12);
    }
  }
}

TEST(FindBonds, FindsTheBondsOfAShell) {
  const Structure network = build_dual(with_bond(testing_support::icosahedron()));
  const Bonding found = bonding_by_distance(network.atoms);
  EXPECT_EQ(coordinations(found), coordinations(network));
}

TEST(FindBonds, ThinksSmallerOfHydrogen) {
  using potentials::Species;
  potentials::Atoms atoms = {.positions = {{0, 0, 0}, {1.6, 0, 0}, {0, 1.5, 0}},
                             .species = {Species::carbon, Species::carbon, Species::hydrogen},
                             .box = {}};
  EXPECT_EQ(coordinations(bonding_by_distance(atoms)), (std::vector<int>{2, 1, 1}));
  atoms.species[1] = Species::hydrogen;
  EXPECT_EQ(coordinations(bonding_by_distance(atoms)), (std::vector<int>{1, 0, 1}));
}

TEST(GrapheneCell, HasGraphenesEnergy) {
  constexpr double published = -7.394997;  // LAMMPS, pair_style rebo, relaxed
  EXPECT_NEAR(potentials::rebo(graphene_cell()).energy / 4.0, published, 1e-6);
}

}  // namespace
}  // namespace trivalent::dual
