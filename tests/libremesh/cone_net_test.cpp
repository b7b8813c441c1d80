#include "crystal/cone_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "crystal/freed_disclinations.h"
#include "crystal/membrane_net.h"
#include "crystal/moved_net.h"
#include "crystal/side_fit.h"
#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/remesh.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

using Triangle = std::array<int, 3>;

/// A net of a shape, with the scars that the paper's method leaves.
TriMesh net_of(std::string_view shape, double faces) {
  const TriMesh surface = make_shape(shape, {}, 0.1);
  const double m = std::sqrt(surface_area(surface) / (faces * unit_triangle_area));
  return remesh(make_shape(shape, {}, 0.5 * m), {.target_edge_length = m}).mesh;
}

ConeNet cone_net_of(const TriMesh& net) { return {triangles_of(net), net.n_vertices()}; }

Triangle smallest_first(Triangle t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  return t;
}

std::map<int, int> valences_of(const TriMesh& net) {
  std::map<int, int> count;
  for (const auto v : net.vertices()) ++count[static_cast<int>(v.valence())];
  return count;
}

TriMesh mesh_of(const ConeNet& cones) {
  const ConeNet::Net net = cones.net();
  return make_mesh(std::vector<Eigen::Vector3d>(net.places.size(), Eigen::Vector3d::Zero()),
                   net.triangles);
}

class ConeNetOf : public testing::TestWithParam<const char*> {};

TEST_P(ConeNetOf, LeavesOnlyDisclinationsAndGivesTheNetBack) {
  const TriMesh net = net_of(GetParam(), 1200.0);
  const ConeNet cones = cone_net_of(net);
  EXPECT_EQ(cones.n_faces(), static_cast<std::int64_t>(net.n_faces()));
  std::set<int> corners;
  for (int h = 0; h < cones.n_halfedges(); ++h) {
    ASSERT_EQ(cones.opposite(cones.opposite(h)), h);
    ASSERT_EQ(cones.to(cones.opposite(h)), cones.from(h));
    corners.insert(cones.from(h));
  }
  for (const int v : corners) EXPECT_NE(net.valence(VertexHandle(v)), 6U);
  EXPECT_EQ(static_cast<int>(corners.size()) - cones.n_halfedges() / 6, euler_characteristic(net));

  const ConeNet::Net again = cones.net();
  ASSERT_EQ(again.places.size(), net.n_vertices());
  std::vector<int> old_number;
  for (const ConeNet::Place& place : again.places) {
    const ConeNet::Mean mean = cones.mean_at(cones, place);
    const auto most = std::ranges::max_element(mean.weights);
    EXPECT_NEAR(*most, 1.0, 1e-12);
    old_number.push_back(mean.vertices[static_cast<std::size_t>(most - mean.weights.begin())]);
  }
  std::set<Triangle> expected;
  for (const Triangle& t : triangles_of(net)) expected.insert(smallest_first(t));
  std::set<Triangle> found;
  for (const Triangle& t : again.triangles) {
    found.insert(smallest_first(
        {old_number[index(t[0])], old_number[index(t[1])], old_number[index(t[2])]}));
  }
  EXPECT_EQ(found, expected);
}

TEST_P(ConeNetOf, KeepsItsDisclinationsWhenTheyMove) {
  const TriMesh net = net_of(GetParam(), 1200.0);
  const ConeNet before = cone_net_of(net);
  ConeNet cones = before;
  int moves = 0;
  for (int h = 0; h < cones.n_halfedges() && moves < 10; h += 7) {
    if (!cones.move(h, turned(LatticeVector(1, 0), h))) continue;
    ++moves;
    const TriMesh moved = mesh_of(cones);
    EXPECT_EQ(cones.n_faces(), static_cast<std::int64_t>(moved.n_faces()));
    std::map<int, int> defects = valences_of(moved);
    std::map<int, int> given = valences_of(net);
    defects.erase(6);
    given.erase(6);
    EXPECT_EQ(defects, given);
    EXPECT_EQ(euler_characteristic(moved), euler_characteristic(net));
    for (const ConeNet::Place& place : cones.net().places) {
      const ConeNet::Mean mean = before.mean_at(cones, place);
      EXPECT_NEAR(mean.weights[0] + mean.weights[1] + mean.weights[2], 1.0, 1e-12);
      EXPECT_GE(std::ranges::min(mean.weights), -1e-12);
    }
  }
  EXPECT_GT(moves, 3);
}

TEST_P(ConeNetOf, MovesSidesAsMuchAsItSays) {
  const TriMesh net = net_of(GetParam(), 1200.0);
  const ConeNet before = cone_net_of(net);
  int moves = 0;
  for (int h = 0; h < before.n_halfedges(); ++h) {
    const LatticeVector by = turned(LatticeVector(1, 0), h);
    ConeNet moved = before;
    if (!moved.move(h, by)) continue;
    ++moves;
    std::vector<std::complex<double>> expected;
    for (int x = 0; x < before.n_halfedges(); ++x) expected.push_back(in_plane(before.side(x)));
    for (const auto& [x, factor] : before.side_changes(h)) {
      expected[index(x)] += factor * in_plane(by);
    }
    for (int x = 0; x < before.n_halfedges(); ++x) {
      EXPECT_LT(std::abs(in_plane(moved.side(x)) - expected[index(x)]), 1e-9);
    }
    ASSERT_TRUE(moved.move(h, -by));
    for (int x = 0; x < before.n_halfedges(); ++x) EXPECT_EQ(moved.side(x), before.side(x));
  }
  EXPECT_GT(moves, 3);
}

TEST_P(ConeNetOf, HasTheSameDisclinationsWhenItIsEnlarged) {
  const TriMesh net = net_of(GetParam(), 400.0);
  const TriMesh larger = mesh_of(cone_net_of(net).enlarged(3));
  EXPECT_EQ(larger.n_faces(), 9 * net.n_faces());
  std::map<int, int> defects = valences_of(larger);
  std::map<int, int> given = valences_of(net);
  defects.erase(6);
  given.erase(6);
  EXPECT_EQ(defects, given);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ConeNetOf, testing::Values("sphere", "torus", "double-torus"),
                         [](const auto& shape) {
                           std::string name = shape.param;
                           std::erase(name, '-');
                           return name;
                         });

/// A net of 20 parts² faces with twelve disclinations, on a sphere where edges have the length of a
/// membrane's.
TriMesh icosahedral_net(int parts) {
  constexpr double t = 1.618033988749895;
  const std::vector<Eigen::Vector3d> corners = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                                {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                                {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  const std::vector<Triangle> triangles = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  const TriMesh icosahedron = make_mesh(corners, triangles);
  const ConeNet given = cone_net_of(icosahedron);
  const ConeNet larger = given.enlarged(parts);
  const ConeNet::Net net = larger.net();
  const double area =
      20.0 * parts * parts * unit_triangle_area * std::pow(Membrane::fine_length, 2);
  const double radius = std::sqrt(area / (4.0 * std::numbers::pi));
  std::vector<Eigen::Vector3d> positions;
  for (const ConeNet::Place& place : net.places) {
    const ConeNet::Mean mean = given.mean_at(larger, place);
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) p += mean.weights[k] * corners[index(mean.vertices[k])];
    positions.push_back(radius * p.normalized());
  }
  return make_mesh(positions, net.triangles);
}

/// Standard deviation of the lengths, over their mean.
double spread_of(const std::vector<double>& lengths) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double length : lengths) {
    sum += length;
    squares += length * length;
  }
  const double mean = sum / static_cast<double>(lengths.size());
  return std::sqrt(squares / static_cast<double>(lengths.size()) / (mean * mean) - 1.0);
}

std::vector<double> side_lengths(const ConeNet& cones) {
  std::vector<double> lengths;
  for (int h = 0; h < cones.n_halfedges(); ++h) lengths.push_back(length_of(cones.side(h)));
  return lengths;
}

TEST(FitSides, FindsANetWhoseSidesAreNearlyAsWanted) {
  const TriMesh net = icosahedral_net(8);
  const ConeNet given = cone_net_of(net);
  ConeNet moved = given;
  for (const int h : {1, 8, 20, 33, 47}) {
    ASSERT_TRUE(moved.move(h, 2 * turned(LatticeVector(1, 0), h)));
  }
  ConeNet fitted = given;
  fit_sides(
      fitted,
      {.lengths = side_lengths(moved), .faces = static_cast<double>(moved.n_faces()), .seed = 1});
  EXPECT_NEAR(static_cast<double>(fitted.n_faces()), static_cast<double>(moved.n_faces()), 12.0);
  double squares_before = 0.0;
  double squares = 0.0;
  for (int h = 0; h < given.n_halfedges(); ++h) {
    const double wanted = length_of(moved.side(h));
    squares_before += std::pow(length_of(given.side(h)) - wanted, 2);
    squares += std::pow(length_of(fitted.side(h)) - wanted, 2);
  }
  // Half an edge is what rounding to the lattice leaves.
  EXPECT_LT(std::sqrt(squares / given.n_halfedges()), 0.3);
  EXPECT_LT(squares, 0.2 * squares_before);
}

TEST(FitSides, LeavesTheNetAsItIsWhereItShouldStop) {
  const ConeNet given = cone_net_of(icosahedral_net(8));
  std::vector<double> longer = side_lengths(given);
  for (double& length : longer) length += 2.0;
  ConeNet fitted = given;
  fit_sides(fitted, {.lengths = std::move(longer),
                     .faces = static_cast<double>(given.n_faces()),
                     .should_stop = [] { return true; }});
  EXPECT_EQ(side_lengths(fitted), side_lengths(given));
}

/// A membrane on a sphere, whose disclinations are freed.
class Freed {
 public:
  Freed(const TriMesh& sphere, const ConstrainedMesh::State& state)
      : mesh_(sphere), constrained_(mesh_) {
    constrained_.restore(state);
    Membrane membrane;
    membrane.tether = 0.006;
    membrane.count = 0.3;
    MembraneNet net(constrained_, sphere, membrane);
    const auto wanted = static_cast<int>(sphere.n_faces());
    constexpr int steps = 400;
    net.relax_across(steps);
    net.renew();
    net.relax_across(steps);
    given_energy = net.elastic_energy() + net.core_energy() +
                   membrane.count_energy(static_cast<int>(mesh_.n_faces()) - wanted);
    freed = free_disclinations(net, wanted);
  }

 private:
  TriMesh mesh_;
  ConstrainedMesh constrained_;

 public:
  double given_energy = 0.0;
  FreedDisclinations freed;
};

ConstrainedMesh::State state_of(TriMesh mesh) { return ConstrainedMesh(mesh).state(); }

TEST(FreeDisclinations, LeavesTheIcosahedronAsItIs) {
  const TriMesh net = icosahedral_net(6);
  const Freed at_rest(net, state_of(net));
  EXPECT_LT(spread_of(at_rest.freed.lengths), 0.01);
  EXPECT_NEAR(at_rest.freed.energy, at_rest.given_energy, 0.05);
}

TEST(FreeDisclinations, TakesMostOfWhatAMoveCosts) {
  const TriMesh net = icosahedral_net(6);
  const Freed at_rest(net, state_of(net));
  TriMesh mesh = net;
  const ConstrainedMesh on_surface(mesh);
  for (const int h : {0, 13}) {
    ConeNet moved = cone_net_of(net);
    ASSERT_TRUE(moved.move(h, LatticeVector(1, 0)));
    const auto other = divided_net(
        net, on_surface.surface(), 1,
        {.lengths = side_lengths(moved), .faces = static_cast<double>(moved.n_faces())});
    ASSERT_TRUE(other);
    const Freed freed(net, *other);
    EXPECT_GT(freed.given_energy, at_rest.given_energy + 5.0);
    EXPECT_LT(freed.freed.energy,
              at_rest.given_energy + 0.25 * (freed.given_energy - at_rest.given_energy));
  }
}

TEST(Crystallize, PutsDisclinationsAboveThoseOfANetBeside) {
  const TriMesh inner = icosahedral_net(5);
  TriMesh surface = make_shape("sphere", {}, 0.05);
  const double radius = inner.point(VertexHandle(0)).norm();
  constexpr double spacing = 3.4;
  scale(surface, radius + spacing);
  const double growth = std::pow(1.0 + spacing / radius, 2);
  const RemeshResult outer =
      crystallize(surface, {.target_edge_length = Membrane::fine_length,
                            .wanted_faces = growth * static_cast<double>(inner.n_faces()),
                            .stiffness = 0.5,
                            .rest = NetRest::in_space,
                            .beside = &inner});
  EXPECT_NEAR(static_cast<double>(outer.mesh.n_faces()),
              growth * static_cast<double>(inner.n_faces()), 0.03 * 900.0);
  int pentagons = 0;
  for (const auto v : outer.mesh.vertices()) {
    if (v.valence() == 6) continue;
    ASSERT_EQ(v.valence(), 5U);
    ++pentagons;
    double nearest = 10.0;
    for (const auto w : inner.vertices()) {
      if (w.valence() != 5) continue;
      const Eigen::Vector3d there = inner.point(w).normalized();
      nearest = std::min(nearest, (outer.mesh.point(v).normalized() - there).norm());
    }
    EXPECT_LT(nearest * radius, Membrane::fine_length);
  }
  EXPECT_EQ(pentagons, 12);
}

}  // namespace
}  // namespace trivalent::remesh
