#include "trivalent/dual/ideal_structures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/shell/ideal_source.h"

namespace trivalent::dual {
namespace {

std::map<int, int> atoms_by_bonds(const Structure& structure) {
  std::map<int, int> counts;
  for (const int number : coordinations(structure)) ++counts[number];
  return counts;
}

void expect_bonds_near(const Structure& structure, double shortest, double longest) {
  for (const potentials::Bond& bond : structure.bonds) {
    const double length = potentials::bond_length(structure.atoms, bond);
    EXPECT_GT(length, shortest);
    EXPECT_LT(length, longest);
  }
}

/// Nothing but the bonds is within reach of a bond.
void expect_no_other_neighbors(const Structure& structure) {
  const potentials::BondChanges changes =
      potentials::bond_changes(structure.atoms, structure.bonds);
  EXPECT_TRUE(changes.formed.empty());
  EXPECT_TRUE(changes.broken.empty());
}

struct Chirality {
  int n;
  int m;
};

class EveryTube : public testing::TestWithParam<Chirality> {};

TEST_P(EveryTube, HasTheAtomsOfItsCellAndThreeBondsEach) {
  const auto [n, m] = GetParam();
  const int divisor = std::gcd(2 * n + m, 2 * m + n);
  for (const int cells : {1, 3}) {
    const Structure tube = nanotube({.n = n, .m = m, .cells = cells});
    const int atoms = cells * 4 * (n * n + n * m + m * m) / divisor;  // [Saito1998, Section 3.3]
    EXPECT_EQ(atoms_by_bonds(tube), (std::map<int, int>{{3, atoms}}));
    // Chords of the thinnest tubes are a tenth shorter than their arcs.
    expect_bonds_near(tube, 0.9 * graphene_bond, 1.00001 * graphene_bond);
    expect_no_other_neighbors(tube);
    const double length =  // [Saito1998, Section 3.3]
        cells * 3.0 * graphene_bond * std::sqrt(n * n + n * m + m * m) / divisor;
    EXPECT_NEAR(tube.atoms.box.cell(2, 2), length, 1e-9);
  }
}

TEST_P(EveryTube, ClosesFreeEndsWithHydrogen) {
  const auto [n, m] = GetParam();
  const Structure bare = nanotube({.n = n, .m = m, .cells = 4, .edges = Edges::bare});
  EXPECT_FALSE(bare.atoms.box.is_periodic());
  for (const auto& [bonds, atoms] : atoms_by_bonds(bare)) {
    EXPECT_TRUE(bonds == 2 || bonds == 3) << atoms << " atoms of " << bonds;
  }
  const Structure capped = nanotube({.n = n, .m = m, .cells = 4, .edges = Edges::hydrogen});
  const auto hydrogens =
      static_cast<int>(std::ranges::count(capped.atoms.species, potentials::Species::hydrogen));
  EXPECT_EQ(hydrogens, atoms_by_bonds(bare)[2]);
  EXPECT_EQ(atoms_by_bonds(capped)[1], hydrogens);
}

INSTANTIATE_TEST_SUITE_P(IdealStructures, EveryTube,
                         testing::Values(Chirality{3, 0}, Chirality{2, 2}, Chirality{5, 5},
                                         Chirality{10, 0}, Chirality{6, 3}, Chirality{3, 6},
                                         Chirality{7, 4}, Chirality{12, 5}),
                         [](const auto& parameter) {
                           return std::to_string(parameter.param.n) + "_" +
                                  std::to_string(parameter.param.m);
                         });

class EveryCapsule : public testing::TestWithParam<Chirality> {};

TEST_P(EveryCapsule, HasTwelvePentagonsAndNoOtherDefect) {
  const auto [n, m] = GetParam();
  for (const double length : {0.0, 15.0}) {
    const Structure capsule = capped_nanotube({.n = n, .m = m, .length = length});
    const auto atoms = static_cast<int>(capsule.atoms.size());
    EXPECT_EQ(atoms_by_bonds(capsule), (std::map<int, int>{{3, atoms}}));
    std::map<std::size_t, int> rings = {{6, 0}};
    std::map<int, int> pentagons_of_atom;
    for (const Ring& ring : capsule.rings) {
      ++rings[ring.atoms.size()];
      if (ring.atoms.size() != 5) continue;
      for (const int atom : ring.atoms) ++pentagons_of_atom[atom];
    }
    EXPECT_EQ(rings, (std::map<std::size_t, int>{{5, 12}, {6, atoms / 2 - 10}}));
    expect_no_other_neighbors(capsule);
    // Pentagons of thinner tubes share bonds, and those of caps that nearly meet.
    if (length == 0.0 || n * n + n * m + m * m < 75) continue;
    EXPECT_EQ(pentagons_of_atom.size(), 60u);
  }
}

/// Bonds of an atom on a tube along z, each as where it leads: around and along [Å]; sorted.
std::vector<std::pair<int, int>> bonds_on_tube(const Structure& tube, std::uint32_t atom) {
  constexpr double places = 4.0;  // in 1/4 Å
  std::vector<std::pair<int, int>> found;
  for (const potentials::Bond& bond : tube.bonds) {
    if (bond.first != atom && bond.second != atom) continue;
    const Eigen::Vector3d from = tube.atoms.positions[atom];
    const std::uint32_t other = bond.first == atom ? bond.second : bond.first;
    const Eigen::Vector3d along = tube.atoms.positions[other] - from;
    const Eigen::Vector3d around =
        Eigen::Vector3d::UnitZ().cross(Eigen::Vector3d(from.x(), from.y(), 0.0)).normalized();
    found.emplace_back(std::lround(places * around.dot(along)), std::lround(places * along.z()));
  }
  std::ranges::sort(found);
  return found;
}

TEST_P(EveryCapsule, IsTheTubeBetweenItsCaps) {
  const auto [n, m] = GetParam();
  const Structure tube = nanotube({.n = n, .m = m, .cells = 4, .edges = Edges::bare});
  std::set<std::vector<std::pair<int, int>>> wanted;
  for (std::uint32_t i = 0; i < tube.atoms.size(); ++i) {
    if (std::abs(tube.atoms.positions[i].z()) < 2.0) wanted.insert(bonds_on_tube(tube, i));
  }
  const Structure capsule = capped_nanotube({.n = n, .m = m, .length = 60.0});
  std::set<std::vector<std::pair<int, int>>> found;
  for (std::uint32_t i = 0; i < capsule.atoms.size(); ++i) {
    if (std::abs(capsule.atoms.positions[i].z()) < 2.0) found.insert(bonds_on_tube(capsule, i));
  }
  EXPECT_EQ(found, wanted);
}

TEST_P(EveryCapsule, IsAsLongAsWanted) {
  const auto [n, m] = GetParam();
  const auto height = [&](double length) {
    const Structure capsule = capped_nanotube({.n = n, .m = m, .length = length});
    const auto [low, high] = std::ranges::minmax(capsule.atoms.positions, {},
                                                 [](const Eigen::Vector3d& p) { return p.z(); });
    return high.z() - low.z();
  };
  // A ring more or less at either length.
  EXPECT_NEAR(height(50.0) - height(20.0), 30.0, 2.46);
  const double radius = 0.5 * 2.46 * std::sqrt(n * n + n * m + m * m) / std::numbers::pi;
  EXPECT_GT(height(50.0), 50.0 + 1.5 * radius);
}

INSTANTIATE_TEST_SUITE_P(IdealStructures, EveryCapsule,
                         testing::Values(Chirality{5, 0}, Chirality{3, 3}, Chirality{5, 5},
                                         Chirality{9, 0}, Chirality{10, 10}, Chirality{12, 5},
                                         Chirality{5, 12}, Chirality{8, 3}, Chirality{17, 0},
                                         Chirality{9, 1}),
                         [](const auto& parameter) {
                           return std::to_string(parameter.param.n) + "_" +
                                  std::to_string(parameter.param.m);
                         });

TEST(CappedNanotube, CapsTheTubeOfC60AsC60) {
  // Half of C60 on either end, and a ring of ten atoms for each 1.23 Å between.
  EXPECT_EQ(capped_nanotube({.n = 5, .m = 5}).atoms.size(), 60u);
  EXPECT_EQ(capped_nanotube({.n = 5, .m = 5, .length = 12.0}).atoms.size(), 160u);
  EXPECT_EQ(capped_nanotube({.n = 10, .m = 10}).atoms.size(), 240u);
  const Structure open =
      capped_nanotube({.n = 5, .m = 5, .length = 12.0, .open_end = Edges::hydrogen});
  EXPECT_EQ(std::ranges::count(open.atoms.species, potentials::Species::hydrogen), 10);
  EXPECT_EQ(atoms_by_bonds(open).count(2), 0u);
}

TEST(CappedNanotube, ClosesEveryChirality) {
  for (int n = 3; n <= 14; ++n) {
    for (int m = 0; m <= n; ++m) {
      if (n * n + n * m + m * m < 25) continue;
      const Structure capsule = capped_nanotube({.n = n, .m = m, .length = 5.0});
      int pentagons = 0;
      for (const Ring& ring : capsule.rings) {
        EXPECT_TRUE(ring.atoms.size() == 5 || ring.atoms.size() == 6) << n << ',' << m;
        if (ring.atoms.size() == 5) ++pentagons;
      }
      EXPECT_EQ(pentagons, 12) << n << ',' << m;
    }
  }
}

TEST(CappedNanotube, RefusesWhatCannotBe) {
  for (const CappedNanotube& tube :
       {CappedNanotube{.n = 4, .m = 0}, CappedNanotube{.n = 3, .m = 2}, CappedNanotube{.n = 0},
        CappedNanotube{.n = 10, .m = -1}, CappedNanotube{.n = 20000},
        CappedNanotube{.length = -1.0}, CappedNanotube{.length = 1e7},
        CappedNanotube{.open_end = Edges::periodic}}) {
    EXPECT_THROW(static_cast<void>(capped_nanotube(tube)), InvalidOption);
  }
}

TEST(GrapheneSheet, IsPeriodicOrHasEdges) {
  const Structure sheet = graphene_sheet(3, 2, Edges::periodic);
  EXPECT_EQ(atoms_by_bonds(sheet), (std::map<int, int>{{3, 24}}));
  expect_bonds_near(sheet, 0.99999 * graphene_bond, 1.00001 * graphene_bond);
  expect_no_other_neighbors(sheet);
  const Structure flake = graphene_sheet(3, 2, Edges::hydrogen);
  const auto counts = atoms_by_bonds(flake);
  EXPECT_EQ(counts.count(2), 0u);
  EXPECT_EQ(counts.at(1), static_cast<int>(std::ranges::count(flake.atoms.species,
                                                              potentials::Species::hydrogen)));
}

TEST(IcosahedralFullerene, HasTwelvePentagonsAndHexagons) {
  // Of all three classes: h and 0, h and h, and others.
  for (const int n_atoms : {20, 60, 80, 140, 180, 240, 260, 420, 540, 980, 1280}) {
    const Structure cage = icosahedral_fullerene(n_atoms);
    EXPECT_EQ(atoms_by_bonds(cage), (std::map<int, int>{{3, n_atoms}})) << n_atoms;
    std::map<std::size_t, int> rings;
    for (const Ring& ring : cage.rings) ++rings[ring.atoms.size()];
    std::map<std::size_t, int> expected = {{5, 12}};
    if (n_atoms > 20) expected[6] = n_atoms / 2 - 10;
    EXPECT_EQ(rings, expected) << n_atoms;
    expect_no_other_neighbors(cage);
  }
}

TEST(IcosahedralFullerene, NamesTheNearestNumbersOfAtoms) {
  try {
    static_cast<void>(icosahedral_fullerene(100));
    FAIL();
  } catch (const InvalidOption& error) {
    EXPECT_NE(std::string(error.what()).find("80 and 140"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(icosahedral_fullerene(-60)), InvalidOption);
  EXPECT_THROW(static_cast<void>(icosahedral_fullerene(61)), InvalidOption);
}

TEST(IcosahedralOnion, HasNoBondAcrossItsWalls) {
  const Structure onion = icosahedral_onion(3);
  EXPECT_EQ(onion.atoms.size(), 60u + 240u + 540u);
  const auto& walls = std::get<std::vector<int>>(onion.columns.at(0).values);
  for (const potentials::Bond& bond : onion.bonds) {
    EXPECT_EQ(walls[bond.first], walls[bond.second]);
  }
  expect_no_other_neighbors(onion);
  EXPECT_THROW(static_cast<void>(icosahedral_onion(0)), InvalidOption);
}

TEST(IdealStructures, RefuseWhatTheyCannotMake) {
  for (const Nanotube& tube : {Nanotube{.n = 0}, Nanotube{.n = 5, .m = -1}, Nanotube{.cells = 0},
                               Nanotube{.n = 2, .m = 1}, Nanotube{.n = 10000, .cells = 100000}}) {
    EXPECT_THROW(static_cast<void>(nanotube(tube)), InvalidOption);
  }
  EXPECT_THROW(static_cast<void>(graphene_sheet(0, 1, Edges::periodic)), InvalidOption);
  EXPECT_THROW(static_cast<void>(graphene_sheet(1, 1, Edges::bare)), InvalidOption);
}

TEST(IdealStructures, AreNamedWithWholeNumbers) {
  using shell::make_ideal_structure;
  EXPECT_EQ(make_ideal_structure("nanotube:n=5,m=5,cells=2").atoms.size(), 40u);
  EXPECT_EQ(make_ideal_structure("fullerene").atoms.size(), 60u);
  EXPECT_EQ(make_ideal_structure("nanotube:n=5,m=5,caps=2").atoms.size(), 60u);
  EXPECT_FALSE(make_ideal_structure("graphene:periodic=0").atoms.box.is_periodic());
  for (const char* text :
       {"nanotube:n=5.5", "nanotube:q=5", "nanotube:periodic=1,hydrogen=1", "fullerene:N=six",
        "nanotube:caps=3", "nanotube:caps=1,cells=2", "nanotube:caps=2,periodic=1",
        "nanotube:caps=2,hydrogen=1", "nanotube:length=10"}) {
    EXPECT_THROW(static_cast<void>(make_ideal_structure(text)), remesh::InvalidOption) << text;
  }
  EXPECT_TRUE(shell::is_ideal_structure("onion:walls=2"));
  EXPECT_FALSE(shell::is_ideal_structure("onion.xyz"));
}

}  // namespace
}  // namespace trivalent::dual
