#include "trivalent/dual/build_dual.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <set>

#include "small_meshes.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::dual {
namespace {

using testing_support::flat_sheet;
using testing_support::icosahedron;
using testing_support::torus;

TEST(BuildDual, TurnsTheIcosahedronIntoC20) {
  const Structure network = build_dual(icosahedron());
  EXPECT_EQ(network.atoms.positions.size(), 20u);
  EXPECT_EQ(network.bonds.size(), 30u);
  ASSERT_EQ(network.rings.size(), 12u);
  for (const auto& ring : network.rings) EXPECT_EQ(ring.atoms.size(), 5u);
}

TEST(BuildDual, PutsAtomsAtTheCentroidsInFaceOrder) {
  const remesh::TriMesh mesh = icosahedron();
  const Structure network = build_dual(mesh);
  const auto triangles = remesh::triangles_of(mesh);
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int corner : triangles[face]) sum += mesh.point(remesh::VertexHandle(corner));
    EXPECT_LT((network.atoms.positions[face] - sum / 3.0).norm(), 1e-15);
  }
}

TEST(BuildDual, ListsEveryBondOnceWithTheSmallerAtomFirst) {
  const Structure network = build_dual(torus(12, 6));
  const std::vector<std::array<int, 2>> bonds = drawable_bonds(network);
  EXPECT_EQ(std::set(bonds.begin(), bonds.end()).size(), network.bonds.size());
  for (const auto& [first, second] : bonds) EXPECT_LT(first, second);
}

TEST(BuildDual, BondsAndRingsGoOnThroughTheCell) {
  const remesh::TriMesh mesh = remesh::make_shape("gyroid", {}, 0.05);
  const Structure structure = build_dual(mesh);
  EXPECT_TRUE(structure.atoms.box.cell.isApprox(Eigen::Matrix3d::Identity()));
  std::size_t through = 0;
  for (const potentials::Bond& bond : structure.bonds) {
    EXPECT_LT(potentials::bond_length(structure.atoms, bond), 0.1);
    if (bond.image != std::array<std::int32_t, 3>{0, 0, 0}) ++through;
  }
  EXPECT_GT(through, 0u);
  EXPECT_LT(drawable_rings(structure).size(), structure.rings.size());
  const Drawing drawing = drawing_of(structure);
  for (const auto& [first, second] : drawing.bonds) {
    EXPECT_LT((drawing.positions[first] - drawing.positions[second]).norm(), 0.1);
  }
  for (const std::vector<int>& ring : drawing.rings) {
    const Eigen::Vector3d step = drawing.positions[ring.front()] - drawing.positions[ring.back()];
    EXPECT_LT(step.norm(), 0.1);
  }
  for (const Eigen::Vector3d& p : structure.atoms.positions) {
    EXPECT_TRUE((p.array() >= 0.0).all() && (p.array() < 1.0).all());
  }
}

TEST(BuildDual, FramesWhatIsNotPeriodic) {
  const Structure tube = build_dual(remesh::make_shape("periodic-tube", {}, 0.2));
  const potentials::Box& box = tube.atoms.box;
  EXPECT_EQ(box.periodic, (std::array{false, false, true}));
  EXPECT_GT(box.cell.determinant(), 0.0);
  EXPECT_DOUBLE_EQ(box.cell(2, 2), 2.0);
  for (const Eigen::Vector3d& p : tube.atoms.positions) {
    const Eigen::Array3d fractions = box.cell.inverse() * (p - box.origin);
    EXPECT_TRUE((fractions >= 0.0).all() && (fractions < 1.0).all());
  }
}

TEST(BuildDual, OrdersRingsAlongBonds) {
  const Structure network = build_dual(torus(12, 6));
  const std::vector<std::array<int, 2>> pairs = drawable_bonds(network);
  const std::set<std::array<int, 2>> bonds(pairs.begin(), pairs.end());
  for (const auto& ring : drawable_rings(network)) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int atom = ring[i];
      const int next = ring[(i + 1) % ring.size()];
      EXPECT_TRUE(bonds.contains({std::min(atom, next), std::max(atom, next)}));
    }
  }
}

TEST(BuildDual, TurnsRingsCounterClockwiseSeenFromOutside) {
  const Structure network = build_dual(icosahedron());
  for (const auto& ring : drawable_rings(network)) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector3d& position = network.atoms.positions[ring[i]];
      area += position.cross(network.atoms.positions[ring[(i + 1) % ring.size()]]);
      center += position;
    }
    EXPECT_GT(area.dot(center), 0.0);
  }
}

TEST(BuildDual, LeavesAtomsWithOneOrTwoBondsAtAnOpenEdge) {
  const NetworkReport report = check_network(build_dual(flat_sheet(4, 3, 1.0)));
  // Each of the two corner rhombi's outer triangles has two boundary edges; 14 boundary edges in
  // all.
  const std::map<int, int> expected = {{1, 2}, {2, 10}, {3, 12}};
  EXPECT_EQ(report.coordinations, expected);
  EXPECT_EQ(report.rings, 6);
  EXPECT_FALSE(report.is_trivalent());
}

TEST(BuildDual, GivesGrapheneItsBondLength) {
  const Structure network = build_dual(flat_sheet(6, 6, edge_length_for_bond(default_bond_length)));
  const NetworkReport report = check_network(network);
  EXPECT_NEAR(report.bond_min, default_bond_length, 1e-14);
  EXPECT_NEAR(report.bond_max, default_bond_length, 1e-14);
  EXPECT_NEAR(mean_bond_length(network), default_bond_length, 1e-14);
}

TEST(BuildDual, ThrowsOnAMeshWithoutFaces) {
  EXPECT_THROW(static_cast<void>(build_dual(remesh::TriMesh())), InvalidNetwork);
}

TEST(BuildDual, ThrowsOnAnInteriorVertexOfValenceTwo) {
  // Two triangles back to back: a closed surface without room for rings.
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const testing_support::Triangles triangles = {{0, 1, 2}, {0, 2, 1}};
  const remesh::TriMesh mesh = remesh::make_mesh(points, triangles);
  EXPECT_THROW(static_cast<void>(build_dual(mesh)), InvalidNetwork);
}

TEST(MeanBondLength, IsZeroWithoutBonds) { EXPECT_EQ(mean_bond_length(Structure()), 0.0); }

}  // namespace
}  // namespace trivalent::dual
