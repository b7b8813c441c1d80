#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesh/geometry.h"
#include "mesh/self_intersections.h"
#include "mesh/surface_projector.h"
#include "mesh_fixtures.h"
#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/periodic.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

using testing_support::is_closed;

struct ExpectedCell {
  std::string name;
  int euler_characteristic;
  double area;       // of a cell of edge 1
  double tolerance;  // relative
};
// Areas of the minimal surfaces P, D (2 x 2 x 2 cells), G; nodal ones differ a little.
const std::vector<ExpectedCell> shapes = {{"schwarz-p", -4, 2.3451, 0.01},
                                          {"schwarz-d", -16, 3.8377, 0.01},
                                          {"gyroid", -8, 3.0915, 0.01},
                                          {"i-wp", -12, 3.464, 0.02},
                                          {"neovius", -16, 3.51, 0.02},
                                          {"plane", 0, 1.0, 1e-12},
                                          {"periodic-tube", 0, 4.0 * std::numbers::pi, 0.01}};

TEST(PeriodicShapes, HaveTheTopologyAndAreaOfTheirNames) {
  for (const auto& [name, euler, area, tolerance] : shapes) {
    for (const double edge_length : {0.05, 0.037, 0.025}) {
      const TriMesh mesh = make_shape(name, {}, edge_length);
      EXPECT_TRUE(mesh.lattice.is_periodic());
      EXPECT_TRUE(is_closed(mesh)) << name;
      EXPECT_EQ(euler_characteristic(mesh), euler) << name << ' ' << edge_length;
      EXPECT_NEAR(mean_edge_length(mesh), edge_length, 0.25 * edge_length) << name;
      EXPECT_EQ(measure_quality(mesh).self_intersections, 0) << name;
      // Chords cut a curved surface's area.
      const double cut = 3.0 * edge_length * edge_length;
      EXPECT_NEAR(surface_area(mesh), area,
                  (tolerance + (tolerance > 1e-9 ? cut * 5.0 : 0.0)) * area)
          << name;
    }
  }
}

TEST(PeriodicShapes, LookOutwardsWhereTheFunctionGrows) {
  const TriMesh plane = make_shape("plane", {{"gamma", 60.0}}, 0.1);
  for (const auto f : plane.faces()) EXPECT_NEAR(face_normal(plane, f).z(), 1.0, 1e-9);
  EXPECT_NEAR(surface_area(plane), std::sin(std::numbers::pi / 3.0), 1e-9);
}

TEST(PeriodicSurface, NearestPointsAreThoseOfAllImages) {
  const TriMesh cell = make_shape("gyroid", {}, 0.05);
  const SurfaceProjector periodic(cell);
  // The same with free copies of the cell around it, every triangle by itself.
  const TriangleSoup soup = soup_of(cell);
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Eigen::Vector3d> translations = cell.lattice.translations_within(1.0);
  translations.emplace_back(0.0, 0.0, 0.0);
  for (const Eigen::Vector3d& t : translations) {
    for (const auto& triangle : soup.triangles) {
      const int first = static_cast<int>(points.size());
      for (const int v : triangle) points.push_back(soup.points[static_cast<std::size_t>(v)] + t);
      triangles.push_back({first, first + 1, first + 2});
    }
  }
  const SurfaceProjector free(make_mesh(points, triangles));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> fraction(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p(fraction(random), fraction(random), fraction(random));
    const Eigen::Vector3d elsewhere = p + cell.lattice.translation({3, -2, 1});
    EXPECT_NEAR(periodic.distance(elsewhere), free.distance(p), 1e-9);
    const SurfacePoint foot = periodic.nearest(elsewhere);
    EXPECT_NEAR((foot.position - elsewhere).norm(), free.distance(p), 1e-9);
    const SurfacePoint walked = periodic.walk_towards(foot.position, foot.face);
    EXPECT_LT((walked.position - foot.position).norm(), 1e-9);
    // Interpolated between vertices, and of the face alone.
    EXPECT_GT(periodic.normal(foot).dot(free.normal(free.nearest(p))), 0.8);
  }
}

TEST(PeriodicSurface, CrossingsAreSeenThroughTheCellsFaces) {
  // Two tubes side by side in a cell, the one nearer to the image of the other than to itself.
  const auto tubes_apart = [](double gap) {
    const TriMesh tube = make_shape("periodic-tube", {{"radius", 0.5}, {"length", 1.0}}, 0.1);
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<int, 3>> triangles;
    for (const double x : {0.5, 1.6}) {
      const int first = static_cast<int>(points.size());
      for (const auto v : tube.vertices()) {
        points.push_back(tube.point(v) + Eigen::Vector3d(x, 0.0, 0.0));
      }
      for (auto triangle : triangles_of(tube)) {
        for (int& v : triangle) v += first;
        triangles.push_back(triangle);
      }
    }
    TriMesh mesh = make_mesh(points, triangles);
    Lattice::Cell cell = tube.lattice.cell();
    cell.col(0) = Eigen::Vector3d(2.1 + gap, 0.0, 0.0);
    mesh.lattice = Lattice(cell, {true, false, true});
    return mesh;
  };
  EXPECT_EQ(find_crossing_faces(tubes_apart(0.1)).count, 0u);
  const CrossingFaces crossing = find_crossing_faces(tubes_apart(-0.05), 1000);
  EXPECT_GT(crossing.count, 0u);
  EXPECT_EQ(crossing.first.size(), crossing.count) << "each pair once, by faces of the cell";
  for (const auto& [a, b] : crossing.first) {
    EXPECT_NE(a, b);
    EXPECT_LT(static_cast<std::size_t>(b), tubes_apart(0.1).n_faces());
  }
}

TEST(PeriodicSurface, RemeshingKeepsTheTopologyByBothMethods) {
  const TriMesh surface = make_shape("schwarz-p", {}, 0.05);
  for (const RemeshMethod& method : std::vector<RemeshMethod>{
           RemeshOptions{}, CrystalOptions{.effort = Effort::quick},
           CrystalOptions{.effort = Effort::quick, .rest = NetRest::in_space}}) {
    const RemeshResult net = remesh_by(surface, method, 0.15);
    EXPECT_EQ(euler_characteristic(net.mesh), -4);
    EXPECT_TRUE(is_closed(net.mesh));
    EXPECT_NEAR(mean_edge_length(net.mesh), 0.15, 0.1 * 0.15);
    EXPECT_LT(net.relative_spread, 0.15);
    const MeshQuality quality = measure_quality(net.mesh);
    EXPECT_EQ(quality.self_intersections, 0);
    EXPECT_LT(measure_distance(net.mesh, surface).to_original.max, 0.15);
  }
}

TEST(PeriodicSurface, AFlatCellBecomesAPerfectNet) {
  // 10 by 6 rectangles of √3 edges of equilateral triangles.
  const TriMesh surface = make_shape("plane", {{"a", 10.0}, {"b", 6.0 * std::numbers::sqrt3}}, 0.5);
  const RemeshResult net =
      crystallize(surface, {.target_edge_length = 1.0, .rest = NetRest::in_space});
  EXPECT_EQ(net.regular_fraction, 1.0);
  EXPECT_EQ(net.mesh.n_faces(), 240u);
  EXPECT_LT(net.relative_spread, 1e-3);
}

TEST(PeriodicSurface, TooSmallACellIsRefused) {
  const TriMesh surface = make_shape("schwarz-p", {}, 0.05);
  try {
    static_cast<void>(remesh(surface, {.target_edge_length = 0.3}));
    FAIL();
  } catch (const InvalidOption& error) {
    EXPECT_NE(std::string(error.what()).find("use at most 0.25, or a supercell"), std::string::npos)
        << error.what();
  }
}

TEST(Repeated, MakesASupercellOfTheSameSurface) {
  const TriMesh mesh = make_shape("gyroid", {}, 0.05);
  const TriMesh twice = repeated(mesh, {2, 1, 3});
  EXPECT_EQ(twice.n_faces(), 6 * mesh.n_faces());
  EXPECT_EQ(euler_characteristic(twice), 6 * euler_characteristic(mesh));
  EXPECT_TRUE(is_closed(twice));
  EXPECT_NEAR(surface_area(twice), 6.0 * surface_area(mesh), 1e-9);
  EXPECT_NEAR(mean_edge_length(twice), mean_edge_length(mesh), 1e-12);
  EXPECT_EQ(measure_quality(twice).components, 1);
  EXPECT_THROW(static_cast<void>(repeated(mesh, {0, 1, 1})), InvalidOption);
  EXPECT_THROW(static_cast<void>(repeated(mesh, {1, 1, 100'000'000})), InvalidOption);
  EXPECT_THROW(static_cast<void>(repeated(testing_support::icosahedron(), {2, 1, 1})),
               InvalidOption);
}

TEST(JoinedInCell, RefusesABoundaryWithoutPartner) {
  const TriMesh sheet = testing_support::triangular_sheet(3, 3);
  const Lattice lattice(Eigen::Vector3d(50.0, 50.0, 50.0).asDiagonal(), {true, true, true});
  EXPECT_THROW(static_cast<void>(joined_in_cell(sheet, lattice)), InvalidMesh);
}

/// One period of a wavy strip along x, with open edges along it.
TriMesh wavy_strip(double period, double width) {
  constexpr int n_x = 40;
  constexpr int n_y = 20;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j <= n_y; ++j) {
    for (int i = 0; i <= n_x; ++i) {
      const double phase = 2.0 * std::numbers::pi * i / n_x;
      points.emplace_back(period * i / n_x, width * j / n_y, 0.05 * period * std::sin(phase));
      if (i == n_x || j == n_y) continue;
      const int a = j * (n_x + 1) + i;
      const int b = a + n_x + 1;
      triangles.push_back({a, a + 1, b + 1});
      triangles.push_back({a, b + 1, b});
    }
  }
  return make_mesh(points, triangles);
}

Lattice box_lattice(double a, const Lattice::Periodic& periodic) {
  return {Eigen::Vector3d(a, 20.0, 20.0).asDiagonal(), periodic};
}

TEST(JoinedInCell, LeavesEdgesOpenBesideThePeriodicDirections) {
  const TriMesh strip =
      joined_in_cell(wavy_strip(6.0, 3.0), box_lattice(6.0, {true, false, false}));
  EXPECT_EQ(euler_characteristic(strip), 0);
  EXPECT_EQ(measure_quality(strip).boundary_loops, 2);
}

TEST(JoinedInCell, RefusesEdgesWhereTheCellDoesNotFit) {
  const TriMesh strip = wavy_strip(6.0, 3.0);
  for (const Lattice& lattice :
       {box_lattice(6.0, {true, true, true}), box_lattice(6.1, {true, false, false}),
        box_lattice(6.0, {false, true, false}), box_lattice(6.0, {true, true, false})}) {
    EXPECT_THROW(static_cast<void>(joined_in_cell(strip, lattice)), InvalidMesh);
  }
  // One end bulges: nothing but its corners has a partner.
  TriMesh bulging = strip;
  for (const auto v : bulging.vertices()) {
    Eigen::Vector3d& p = bulging.point(v);
    p.x() += 0.01 * p.x() * p.y() * (3.0 - p.y());
  }
  EXPECT_THROW(static_cast<void>(joined_in_cell(bulging, box_lattice(6.0, {true, false, false}))),
               InvalidMesh);
  // At one end a vertex too many.
  TriMesh slit = strip;
  for (const auto e : slit.edges()) {
    if (!e.is_boundary() || slit.point(e.v0()).x() != 0.0 || slit.point(e.v1()).x() != 0.0)
      continue;
    slit.split(e, Eigen::Vector3d(0.5 * (slit.point(e.v0()) + slit.point(e.v1()))));
    break;
  }
  EXPECT_THROW(static_cast<void>(joined_in_cell(slit, box_lattice(6.0, {true, false, false}))),
               InvalidMesh);
}

TEST(PeriodicSurface, KeepsItsEdgesInBothMethods) {
  const Lattice lattice = box_lattice(6.0, {true, false, false});
  const TriMesh strip = joined_in_cell(wavy_strip(6.0, 3.0), lattice);
  const CrystalOptions on_surface = {.target_edge_length = 0.25, .effort = Effort::quick};
  CrystalOptions in_space = on_surface;
  in_space.rest = NetRest::in_space;
  for (const RemeshMethod& method :
       {RemeshMethod(RemeshOptions{}), RemeshMethod(on_surface), RemeshMethod(in_space)}) {
    const TriMesh net = remesh_by(strip, method, 0.25).mesh;
    const MeshQuality quality = measure_quality(net);
    EXPECT_EQ(quality.boundary_loops, 2);
    EXPECT_EQ(quality.euler_characteristic, 0);
    EXPECT_EQ(quality.self_intersections, 0);
    EXPECT_NEAR(quality.edge_length.mean, 0.25, 0.02);
    for (const auto v : net.vertices()) {
      if (!v.is_boundary()) continue;
      const double y = net.point(v).y();
      EXPECT_LT(std::min(std::abs(y), std::abs(y - 3.0)), 0.25) << v.idx();
    }
  }
}

TEST(PeriodicSurface, FollowsCreasesAcrossTheCell) {
  // A roof whose ridge and valley run along y.
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  constexpr int n = 24;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      points.emplace_back(6.0 * i / n, 6.0 * j / n, 0.25 * std::min(i, n - i));
      if (i == n || j == n) continue;
      const int a = j * (n + 1) + i;
      triangles.push_back({a, a + 1, a + n + 2});
      triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  const Lattice lattice(Eigen::Vector3d(6.0, 6.0, 20.0).asDiagonal(), {true, true, false});
  const TriMesh roof = joined_in_cell(make_mesh(points, triangles), lattice);
  const double area = 2.0 * std::hypot(3.0, 3.0) * 6.0;
  ASSERT_NEAR(surface_area(roof), area, 1e-9);
  const TriMesh net =
      remesh(roof, {.target_edge_length = 0.3, .iterations = 10, .feature_angle = 0.7}).mesh;
  // Faces that bridge a crease would be shorter.
  EXPECT_NEAR(surface_area(net), area, 1e-6 * area);
}

TEST(JoinedInCell, TakesClosedSurfacesThatKeepClearOfTheirImages) {
  const TriMesh sphere = make_shape("sphere", {}, 0.2);
  const auto in_cube = [&](double a) {
    return joined_in_cell(sphere, Lattice(a * Lattice::Cell::Identity(), {true, true, true}));
  };
  EXPECT_EQ(euler_characteristic(in_cube(2.2)), 2);
  EXPECT_THROW(static_cast<void>(in_cube(1.9)), InvalidMesh);
}

TEST(JoinedInCell, HalvesEdgesThatAreLongForTheLattice) {
  // Two triangles show a flat cell.
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {6, 0, 0}, {6, 5, 0}, {0, 5, 0}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const Lattice lattice(Eigen::Vector3d(6.0, 5.0, 9.0).asDiagonal(), {true, true, true});
  const TriMesh mesh = joined_in_cell(make_mesh(points, triangles), lattice);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_NEAR(surface_area(mesh), 30.0, 1e-12);
  for (const auto e : mesh.edges()) EXPECT_LT(edge_length(mesh, e), 0.5 * lattice.shortest());
}

TEST(SoupOf, CutsOneCellOpen) {
  const TriMesh mesh = make_shape("schwarz-p", {}, 0.05);
  const TriangleSoup soup = soup_of(mesh);
  EXPECT_EQ(soup.triangles.size(), mesh.n_faces());
  EXPECT_GT(soup.points.size(), mesh.n_vertices());
  double area = 0.0;
  for (const auto& [a, b, c] : soup.triangles) {
    const auto at = [&](int v) { return soup.points[static_cast<std::size_t>(v)]; };
    area += 0.5 * doubled_area_vector(at(a), at(b), at(c)).norm();
  }
  EXPECT_NEAR(area, surface_area(mesh), 1e-9);
}

}  // namespace
}  // namespace trivalent::remesh
