#include "crystal/cell_net.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "crystal/cell_net_places.h"
#include "crystal/cell_net_search.h"
#include "crystal/membrane.h"
#include "crystal/primitive_cell.h"
#include "trivalent/remesh/remesh.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

/// A surface whose cell holds so many faces of edges as long as a membrane's.
TriMesh surface_for(std::string_view shape, double faces) {
  TriMesh mesh = make_shape(shape, {}, 0.03);
  const double area = faces * unit_triangle_area * Membrane::fine_length * Membrane::fine_length;
  scale(mesh, std::sqrt(area / surface_area(mesh)));
  return mesh;
}

TriMesh p_surface(double faces) { return surface_for("schwarz-p", faces); }

CellNet p_net() {
  return CellNet::of(remesh(p_surface(192.0), {.target_edge_length = Membrane::fine_length}).mesh);
}

Lattice p_lattice() { return p_surface(192.0).lattice; }

std::map<int, int> valences_of(const CellNet& net) {
  std::map<int, int> count;
  for (int v = 0; v < net.n_vertices(); ++v) ++count[net.valence(v)];
  return count;
}

/// Half-edges in pairs of opposite directions, edges that close around every triangle, valences as
/// counted, and the Euler characteristic of P.
void expect_whole(const CellNet& net) {
  std::vector<int> valences(net.positions.size(), 0);
  for (int h = 0; h < net.n_halfedges(); ++h) {
    const int g = net.opposite(h);
    ASSERT_EQ(net.opposite(g), h);
    ASSERT_EQ(net.to(g), net.from(h));
    const int first = h - h % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(net.image(h)[k], -net.image(g)[k]);
      ASSERT_EQ(net.image(first)[k] + net.image(first + 1)[k] + net.image(first + 2)[k], 0);
    }
    ++valences[index(net.to(h))];
  }
  for (int v = 0; v < net.n_vertices(); ++v) EXPECT_EQ(net.valence(v), valences[index(v)]) << v;
  EXPECT_EQ(net.n_vertices() - net.n_halfedges() / 6, -4);  // edges - faces = faces / 2
}

TEST(CellNet, HasTheEdgesOfItsMesh) {
  const TriMesh mesh = p_surface(192.0);
  const CellNet net = CellNet::of(mesh);
  expect_whole(net);
  EXPECT_TRUE(net.is_simplicial());
  double sum = 0.0;
  for (int h = 0; h < net.n_halfedges(); ++h) sum += net.edge_vector(h, mesh.lattice).norm();
  EXPECT_NEAR(sum / net.n_halfedges(), mean_edge_length(mesh), 1e-9);
}

TEST(CellNet, FlipsAnEdgeThereAndBack) {
  CellNet net = p_net();
  const Lattice lattice = p_lattice();
  int flipped = 0;
  for (int h = 0; h < net.n_halfedges(); h += 7) {
    const double length = net.edge_vector(h, lattice).norm();
    const double diagonal = net.diagonal_length(h, lattice);
    if (!net.flip(h)) continue;
    ++flipped;
    EXPECT_NEAR(net.edge_vector(h, lattice).norm(), diagonal, 1e-12);
    EXPECT_NEAR(net.diagonal_length(h, lattice), length, 1e-12);
    if (flipped % 2 == 0) continue;
    ASSERT_TRUE(net.flip(h));
    EXPECT_NEAR(net.edge_vector(h, lattice).norm(), length, 1e-12);
  }
  EXPECT_GT(flipped, 10);
  expect_whole(net);
}

TEST(CellNet, RemovesAVertexOfThreeNeighbors) {
  CellNet net = p_net();
  const int vertices = net.n_vertices();
  for (int h = 0; h < net.n_halfedges() && net.valence(5) > 3; ++h) {
    if (net.from(h) == 5) net.flip(h);
  }
  ASSERT_EQ(net.valence(5), 3);
  net.remove(5);
  EXPECT_EQ(net.n_vertices(), vertices - 1);
  expect_whole(net);
}

TEST(CellNet, GetsNewVerticesOfSixNeighborsByDivision) {
  const CellNet net = p_net();
  const Lattice lattice = p_lattice();
  const int faces = net.n_halfedges() / 3;
  const int edges = net.n_halfedges() / 2;
  const std::map<int, int> before = valences_of(net);
  const auto expect_division = [&](const CellNet& divided, int each, int added) {
    expect_whole(divided);
    EXPECT_EQ(divided.n_halfedges() / 3, each * faces);
    EXPECT_EQ(divided.n_vertices(), net.n_vertices() + added);
    std::map<int, int> wanted = before;
    wanted[6] += added;
    EXPECT_EQ(valences_of(divided), wanted);
    for (int v = 0; v < net.n_vertices(); ++v) {
      EXPECT_EQ(divided.positions[index(v)], net.positions[index(v)]);
    }
  };
  for (const int parts : {1, 2, 3, 5}) {
    const CellNet divided = net.divided(parts, lattice);
    expect_division(divided, parts * parts,
                    (parts - 1) * edges + (parts - 1) * (parts - 2) / 2 * faces);
    // All parts of an edge are as long.
    double sum = 0.0;
    for (int h = 0; h < net.n_halfedges(); ++h) sum += net.edge_vector(h, lattice).norm();
    double divided_sum = 0.0;
    for (int h = 0; h < divided.n_halfedges(); ++h) {
      divided_sum += divided.edge_vector(h, lattice).norm();
    }
    EXPECT_NEAR(divided_sum, parts * sum, 1e-9 * sum);
  }
  expect_division(net.divided_by_sqrt3(lattice), 3, faces);
}

// P's net of one octagon at each of twelve places has 48 triangles, 20 vertices.
TEST(PlanCellDivision, ComesFromTheFewestVerticesThatGiveTheNumber) {
  const auto expect_plan = [](int atoms, int base, int parts, bool by_sqrt3) {
    const auto plan = plan_cell_division(atoms / 2 - 4, -4);
    ASSERT_TRUE(plan) << atoms;
    EXPECT_EQ(plan->base_vertices, base) << atoms;
    EXPECT_EQ(plan->parts, parts) << atoms;
    EXPECT_EQ(plan->by_sqrt3, by_sqrt3) << atoms;
  };
  expect_plan(144, 20, 1, true);
  expect_plan(192, 20, 2, false);
  expect_plan(432, 20, 3, false);
  expect_plan(576, 20, 2, true);
  expect_plan(1200, 20, 5, false);
  EXPECT_FALSE(plan_cell_division(10, -4));      // too few
  EXPECT_FALSE(plan_cell_division(100000, -4));  // too many
  EXPECT_FALSE(plan_cell_division(1000, -24));   // too many places
}

TEST(SearchCellNet, FindsTheTwelveOctagonsOfP) {
  const TriMesh surface = p_surface(192.0);
  const TriMesh start = remesh(surface, {.target_edge_length = Membrane::fine_length}).mesh;
  const std::vector<CellNet> nets = search_cell_nets(
      start, surface, {.division = *plan_cell_division(92, -4), .runs = 12, .max_nets = 2});
  ASSERT_EQ(nets.size(), 2u);
  EXPECT_NE(valences_of(nets[0]), valences_of(nets[1]));
  const CellNet& net = nets[0];
  expect_whole(net);
  EXPECT_TRUE(net.is_simplicial());
  EXPECT_EQ(valences_of(net), (std::map<int, int>{{6, 80}, {8, 12}}));
}

// Twelve places of D's primitive cell are saddles with a normal along an axis of the cube. Random
// nets to start from never led to their octagons.
TEST(SearchCellNet, FindsTheTwelveOctagonsOfDAtOnce) {
  const auto cell = primitive_cell(surface_for("schwarz-d", 576.0), Membrane::fine_length);
  ASSERT_TRUE(cell);
  ASSERT_EQ(cell->copies, 4);
  const TriMesh start = remesh(cell->surface, {.target_edge_length = 2.0}).mesh;
  const std::vector<CellNet> nets =
      search_cell_nets(start, cell->surface, {.division = *plan_cell_division(68, -4), .runs = 1});
  ASSERT_EQ(nets.size(), 1u);
  expect_whole(nets[0]);
  EXPECT_EQ(valences_of(nets[0]), (std::map<int, int>{{6, 56}, {8, 12}}));
}

TEST(FindPlaces, PutsTheSaddlesFirstOnTheInsideOfATorus) {
  const TriMesh torus = make_shape("torus", {{"R", 3.0}, {"r", 1.0}}, 0.1);
  const auto places = find_places(torus, {.saddles = 4, .all = 12, .spacing = 1.0});
  ASSERT_EQ(places.size(), 12u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(places[i].head<2>().norm(), 2.0, 0.05) << i;
    EXPECT_NEAR(places[i].z(), 0.0, 0.3) << i;
  }
  EXPECT_GT(places[4].head<2>().norm(), 3.0);  // as far from them as possible
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((places[i] - places[j]).norm(), 0.6);
  }
}

TEST(FindPlaces, SeesImagesInACell) {
  const TriMesh surface = p_surface(192.0);
  const auto places = find_places(surface, {.saddles = 12, .all = 20, .spacing = 5.0});
  ASSERT_EQ(places.size(), 20u);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d image = surface.lattice.near(places[i], places[j]);
      EXPECT_GE((image - places[i]).norm(), 3.0) << i << ' ' << j;
    }
  }
}

TEST(FindPlaces, ReturnsFewerWhereTheSurfaceHasNoMore) {
  const TriMesh torus = make_shape("torus", {}, 0.5);
  const auto n = static_cast<int>(torus.n_vertices());
  EXPECT_EQ(find_places(torus, {.saddles = 0, .all = n + 5, .spacing = 0.5}).size(),
            torus.n_vertices());
}

}  // namespace
}  // namespace trivalent::remesh
