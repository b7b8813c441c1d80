#include "trivalent/potentials/neighbor_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "random_atoms.h"
#include "trivalent/potentials/error.h"

namespace trivalent::potentials {
namespace {

using testing_support::cube;
using testing_support::periodic;
using testing_support::random_gas;

using Id = std::tuple<std::uint32_t, int, int, int>;

// All neighbors of an atom by trying every atom and every image within some cells.
std::vector<Id> neighbors_by_search(const Atoms& atoms, std::size_t i, double cutoff, int images) {
  const auto range = [&](std::size_t k) { return atoms.box.periodic[k] ? images : 0; };
  std::vector<Id> found;
  for (std::uint32_t j = 0; j < atoms.size(); ++j) {
    for (int a = -range(0); a <= range(0); ++a) {
      for (int b = -range(1); b <= range(1); ++b) {
        for (int c = -range(2); c <= range(2); ++c) {
          const Eigen::Vector3d x = atoms.positions[j] + atoms.box.cell * Eigen::Vector3d(a, b, c);
          const double distance = (x - atoms.positions[i]).norm();
          if (distance > 0.0 && distance < cutoff) found.emplace_back(j, a, b, c);
        }
      }
    }
  }
  return found;
}

std::vector<Id> ids(std::span<const Neighbor> neighbors) {
  std::vector<Id> result;
  for (const Neighbor& n : neighbors) {
    result.emplace_back(n.atom, n.image[0], n.image[1], n.image[2]);
  }
  return result;
}

void expect_all_found(const Atoms& atoms, double cutoff, int images) {
  const NeighborList list(atoms, cutoff);
  ASSERT_EQ(list.size(), atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    EXPECT_EQ(ids(list[i]), neighbors_by_search(atoms, i, cutoff, images)) << "atom " << i;
    for (const Neighbor& n : list[i]) {
      const Eigen::Vector3d image(n.image[0], n.image[1], n.image[2]);
      const Eigen::Vector3d expected =
          atoms.positions[n.atom] + atoms.box.cell * image - atoms.positions[i];
      EXPECT_LT((n.separation - expected).norm(), 1e-12);
      EXPECT_DOUBLE_EQ(n.distance, n.separation.norm());
    }
  }
}

Box triclinic() {
  Box box;
  box.cell << 5.0, 1.7, -1.1, 0.0, 4.0, 0.9, 0.0, 0.0, 6.0;
  return periodic(box);
}

TEST(NeighborList, FindsAllPairsInFreeSpace) {
  expect_all_found(random_gas(300, cube(12.0), 1), 2.0, 0);
}

TEST(NeighborList, FindsAllPairsAndImagesInAPeriodicBox) {
  expect_all_found(random_gas(200, periodic(cube(8.0)), 2), 2.0, 1);
}

TEST(NeighborList, FindsAllPairsAndImagesInATriclinicBox) {
  expect_all_found(random_gas(60, triclinic(), 3), 2.5, 2);
}

TEST(NeighborList, FindsSeveralImagesInACellSmallerThanTheCutoff) {
  expect_all_found(random_gas(3, periodic(cube(1.3)), 4), 4.0, 5);
}

TEST(NeighborList, FindsNeighborsAlongOnePeriodicDirectionOnly) {
  Atoms atoms = random_gas(50, cube(5.0), 5);
  atoms.box.periodic = {false, true, false};
  atoms.box.cell.col(0).setZero();  // a direction that is not periodic needs no cell vector
  expect_all_found(atoms, 2.0, 1);
}

TEST(NeighborList, CountsImagesFromPositionsOutsideTheCell) {
  Atoms atoms = random_gas(40, triclinic(), 6);
  for (std::size_t i = 0; i < atoms.size(); i += 3) {
    atoms.positions[i] += atoms.box.cell * Eigen::Vector3d(2.0, -1.0, 1.0);
  }
  expect_all_found(atoms, 2.0, 4);
}

TEST(NeighborList, TakesNoMemoryForEmptySpace) {
  Atoms atoms = random_gas(100, cube(6.0), 7);
  const Atoms far = random_gas(100, cube(6.0), 8);
  for (const Eigen::Vector3d& x : far.positions) {
    atoms.positions.emplace_back(x + Eigen::Vector3d::Constant(1e9));
    atoms.species.push_back(Species::carbon);
  }
  expect_all_found(atoms, 2.0, 0);
}

// Images at exactly the cutoff: rounding must not find a pair from one end only.
TEST(NeighborList, FindsPairsFromBothEndsOrNotAtAll) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Atoms atoms = random_gas(6, periodic(cube(2.0)), seed);
    const NeighborList list(atoms, 2.0);
    for (std::uint32_t i = 0; i < atoms.size(); ++i) {
      for (const Neighbor& n : list[i]) {
        const Id back(i, -n.image[0], -n.image[1], -n.image[2]);
        const auto others = ids(list[n.atom]);
        EXPECT_NE(std::ranges::find(others, back), others.end());
      }
    }
  }
}

TEST(NeighborList, IsEmptyWithoutAtoms) { EXPECT_EQ(NeighborList(Atoms{}, 2.0).size(), 0u); }

TEST(NeighborList, ThrowsOnAPositionThatIsNotFinite) {
  Atoms atoms = random_gas(5, cube(6.0), 9);
  atoms.positions[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(NeighborList(atoms, 2.0), InvalidAtoms);
  atoms.positions[3][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(NeighborList(atoms, 2.0), InvalidAtoms);
}

TEST(NeighborList, ThrowsOnCoincidentAtoms) {
  Atoms atoms = random_gas(5, cube(6.0), 10);
  atoms.positions[4] = atoms.positions[1];
  EXPECT_THROW(NeighborList(atoms, 2.0), InvalidAtoms);
}

TEST(NeighborList, ThrowsOnFewerSpeciesThanPositions) {
  Atoms atoms = random_gas(5, cube(6.0), 11);
  atoms.species.pop_back();
  EXPECT_THROW(NeighborList(atoms, 2.0), InvalidAtoms);
}

TEST(NeighborList, ThrowsOnAMissingOrFlatCell) {
  Atoms atoms = random_gas(5, periodic(cube(6.0)), 12);
  atoms.box.cell.col(2).setZero();
  EXPECT_THROW(NeighborList(atoms, 2.0), InvalidAtoms);
  atoms.box.cell.col(2) = atoms.box.cell.col(0) + atoms.box.cell.col(1);
  EXPECT_THROW(NeighborList(atoms, 2.0), InvalidAtoms);
}

TEST(NeighborList, ThrowsOnACellWithMoreImagesThanCanBeCounted) {
  EXPECT_THROW(NeighborList(random_gas(1, periodic(cube(1e-6)), 13), 2.0), InvalidAtoms);
}

TEST(NeighborList, ThrowsOnACutoffThatIsNotPositive) {
  EXPECT_THROW(NeighborList(Atoms{}, 0.0), InvalidOption);
  EXPECT_THROW(NeighborList(Atoms{}, std::numeric_limits<double>::quiet_NaN()), InvalidOption);
}

}  // namespace
}  // namespace trivalent::potentials
