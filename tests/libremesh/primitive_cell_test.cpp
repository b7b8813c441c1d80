#include "crystal/primitive_cell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/periodic.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/remesh/surface_shape.h"

namespace trivalent::remesh {
namespace {

constexpr double max_gap = 0.005;

double volume_of(const Lattice& lattice) { return lattice.cell().determinant(); }

TEST(PrimitiveLattice, IsBodyCenteredForTheGyroid) {
  const Lattice lattice = primitive_lattice(make_shape("gyroid", {}, 0.03), max_gap);
  EXPECT_NEAR(volume_of(lattice), 0.5, 1e-12);
  EXPECT_NEAR(lattice.shortest(), 0.5 * std::sqrt(3.0), 1e-12);
}

TEST(PrimitiveLattice, IsFaceCenteredForD) {
  // The cell of D as built in: translations that exchange its sides do not count.
  const TriMesh surface = make_shape("schwarz-d", {}, 0.03);
  const Lattice lattice = primitive_lattice(surface, max_gap);
  EXPECT_EQ(euler_characteristic(surface) * volume_of(lattice), -4.0 * volume_of(surface.lattice));
}

TEST(PrimitiveLattice, OfASupercellIsTheCell) {
  const TriMesh surface = make_shape("schwarz-p", {}, 0.05);
  for (const std::array<int, 3>& times : {std::array{1, 1, 1}, {2, 1, 1}, {3, 1, 2}, {4, 1, 1}}) {
    const Lattice lattice = primitive_lattice(repeated(surface, times), max_gap);
    EXPECT_TRUE(lattice.cell().cwiseAbs().isApprox(Eigen::Matrix3d::Identity(), 1e-12))
        << lattice.cell();
  }
}

TEST(PrimitiveCell, IsOfTheSameSurface) {
  const TriMesh surface = make_shape("gyroid", {}, 0.03);
  const auto primitive = primitive_cell(surface, 0.05);
  ASSERT_TRUE(primitive);
  EXPECT_EQ(primitive->copies, 2);
  EXPECT_EQ(euler_characteristic(primitive->surface), -4);
  EXPECT_NEAR(2.0 * surface_area(primitive->surface), surface_area(surface),
              0.002 * surface_area(surface));
}

TEST(PrimitiveCell, IsNoneWhereItWouldBeTheSameOrTooSmall) {
  EXPECT_FALSE(primitive_cell(make_shape("schwarz-p", {}, 0.05), 0.05));
  EXPECT_FALSE(primitive_cell(make_shape("gyroid", {}, 0.05), 0.2));
  EXPECT_FALSE(primitive_cell(make_shape("plane", {}, 0.2), 0.2));
  EXPECT_FALSE(primitive_cell(make_shape("sphere", {}, 0.2), 0.2));
}

TEST(InSupercell, CopiesASurfaceIntoAnObliqueMultiple) {
  const TriMesh surface = make_shape("schwarz-p", {}, 0.05);
  Lattice::Cell cell;
  cell << 1, 0, 1, 1, 2, 0, 0, 1, 3;
  const TriMesh copies = in_supercell(surface, Lattice(cell, {true, true, true}));
  const double n = cell.determinant();
  EXPECT_EQ(static_cast<double>(copies.n_faces()), n * static_cast<double>(surface.n_faces()));
  EXPECT_EQ(euler_characteristic(copies), -4.0 * n);
  EXPECT_NEAR(surface_area(copies), n * surface_area(surface), 1e-9);
  EXPECT_EQ(find_components(copies).parts.size(), 1u);
  EXPECT_THROW(static_cast<void>(in_supercell(surface, Lattice(0.5 * cell, {true, true, true}))),
               InvalidOption);
  EXPECT_THROW(static_cast<void>(in_supercell(make_shape("sphere", {}, 0.2), surface.lattice)),
               InvalidOption);
}

TEST(Crystallize, CopiesTheNetOfThePrimitiveCell) {
  const TriMesh surface = repeated(make_shape("schwarz-p", {}, 0.04), {1, 2, 1});
  const CrystalOptions options = {.target_edge_length = 0.15,
                                  .wanted_faces = 2.0 * 290.0,
                                  .effort = Effort::quick,
                                  .rest = NetRest::in_space};
  const RemeshResult result = crystallize(surface, options);
  EXPECT_EQ(result.copies, 2);
  const TriMesh& net = result.mesh;
  EXPECT_EQ(euler_characteristic(net), -8);
  ASSERT_EQ(net.n_vertices() % 2, 0u);
  const auto half = static_cast<int>(net.n_vertices() / 2);
  for (int v = 0; v < half; ++v) {
    EXPECT_EQ(net.valence(VertexHandle(v)), net.valence(VertexHandle(v + half)));
  }
}

}  // namespace
}  // namespace trivalent::remesh
