#include "trivalent/remesh/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::remesh {
namespace {

using std::numbers::pi;
using testing_support::is_closed;
using testing_support::signed_volume;

struct Expected {
  std::string name;
  int euler_characteristic;
  bool closed;
};
/// But for the periodic ones.
const std::vector<Expected> all_shapes = {{"sphere", 2, true},     {"ellipsoid", 2, true},
                                          {"torus", 0, true},      {"double-torus", -2, true},
                                          {"capsule", 2, true},    {"tube", 2, true},
                                          {"open-tube", 0, false}, {"wavy-sheet", 1, false}};

double longest_edge(const TriMesh& mesh) {
  double longest = 0.0;
  for (const auto e : mesh.edges()) longest = std::max(longest, mesh.calc_edge_length(e));
  return longest;
}

double shortest_edge(const TriMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto e : mesh.edges()) shortest = std::min(shortest, mesh.calc_edge_length(e));
  return shortest;
}

TEST(BuiltInShapes, AreTheDocumentedOnes) {
  std::vector<std::string> names;
  for (const Expected& shape : all_shapes) names.push_back(shape.name);
  for (const char* name :
       {"y-junction", "t-junction", "x-junction", "tetrapod", "six-arm-junction", "junction",
        "cubic-network", "diamond-network", "honeycomb-network", "schwarz-p", "schwarz-d", "gyroid",
        "i-wp", "neovius", "plane", "periodic-tube", "wave"}) {
    names.emplace_back(name);
  }
  ASSERT_EQ(built_in_shapes().size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(built_in_shapes()[k].name, names[k]);
}

TEST(MakeShape, HasTheTopologyOfItsNameAtEveryResolution) {
  for (const auto& [name, euler, closed] : all_shapes) {
    for (const double edge_length : {0.3, 0.2, 0.1, 0.05, 0.037}) {
      const TriMesh mesh = make_shape(name, {}, edge_length);
      EXPECT_EQ(euler_characteristic(mesh), euler) << name << ' ' << edge_length;
      EXPECT_EQ(is_closed(mesh), closed) << name << ' ' << edge_length;
      if (!closed) continue;
      EXPECT_GT(signed_volume(mesh), 0.0) << name << ' ' << edge_length;
    }
  }
}

TEST(MakeShape, HasEdgesNearTheWantedLength) {
  for (const auto& [name, euler, closed] : all_shapes) {
    for (const double edge_length : {0.1, 0.05}) {
      const TriMesh mesh = make_shape(name, {}, edge_length);
      EXPECT_NEAR(mean_edge_length(mesh), edge_length, 0.06 * edge_length) << name;
      // The ellipsoid's triangles stretch with its axes, 1.5 to 0.75.
      EXPECT_LT(longest_edge(mesh), 1.9 * edge_length) << name;
      EXPECT_GT(shortest_edge(mesh), 0.3 * edge_length) << name;
    }
  }
}

TEST(MakeShape, ScalesWithItsParameters) {
  const TriMesh small = make_shape("torus", {{"R", 1.0}, {"r", 0.25}}, 0.1);
  const TriMesh large = make_shape("torus", {{"R", 1e6}, {"r", 0.25e6}}, 0.1e6);
  ASSERT_EQ(small.n_faces(), large.n_faces());
  EXPECT_NEAR(surface_area(large), 1e12 * surface_area(small), 1e-9 * surface_area(large));
}

TEST(Sphere, LiesOnItsRadiusAndHasTwelveVerticesOfValenceFive) {
  // Any frequency, not only powers of two: 10 f² + 2 vertices.
  for (const int frequency : {1, 2, 3, 5, 7, 11}) {
    const double edge_length = std::sqrt(4.0 * pi * 9.0 / (5.0 * std::sqrt(3.0))) / frequency;
    const TriMesh mesh = make_shape("sphere", {{"radius", 3.0}}, edge_length);
    EXPECT_EQ(mesh.n_vertices(), static_cast<std::size_t>(10 * frequency * frequency + 2));
    int fives = 0;
    for (const auto v : mesh.vertices()) {
      EXPECT_NEAR(mesh.point(v).norm(), 3.0, 1e-14 * 3.0);
      if (mesh.valence(v) == 5)
        ++fives;
      else
        EXPECT_EQ(mesh.valence(v), 6u);
    }
    EXPECT_EQ(fives, 12);
  }
}

/// Relative loss of area and volume to flat triangles of edge 0.05 on radii of curvature >= 0.4 is
/// about (edge/radius)²/8, at most 0.002.
constexpr double discretization = 0.002;

TEST(MakeShape, HasTheAreaAndVolumeOfTheFormula) {
  const auto expect = [](const TriMesh& mesh, double area, double volume) {
    EXPECT_NEAR(surface_area(mesh), area, discretization * area);
    EXPECT_NEAR(signed_volume(mesh), volume, 2.0 * discretization * volume);
  };
  expect(make_shape("sphere", {}, 0.05), 4.0 * pi, 4.0 / 3.0 * pi);
  expect(make_shape("torus", {}, 0.05), 4.0 * pi * pi * 0.4, 2.0 * pi * pi * 0.16);
  expect(make_shape("capsule", {}, 0.05), 4.0 * pi + 6.0 * pi, 4.0 / 3.0 * pi + 3.0 * pi);
  expect(make_shape("tube", {}, 0.05), 2.0 * pi + 8.0 * pi, 4.0 * pi);
  EXPECT_NEAR(signed_volume(make_shape("ellipsoid", {}, 0.05)), 4.0 / 3.0 * pi * 1.5 * 0.75, 0.02);
  EXPECT_NEAR(surface_area(make_shape("open-tube", {}, 0.05)), 8.0 * pi, discretization * 8.0 * pi);
  EXPECT_NEAR(surface_area(make_shape("wavy-sheet", {{"amplitude", 0.0}}, 0.05)), 4.0, 1e-12);
}

TEST(DoubleTorus, IsTwoToriAwayFromWhereTheyJoin) {
  const TriMesh mesh = make_shape("double-torus", {}, 0.1);
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d& p = mesh.point(v);
    if (std::abs(p.x()) < 1.0) continue;
    const double rho = std::hypot(std::abs(p.x()) - 1.0, p.y()) - 1.0;
    // There the other torus is at least 0.7 away and lifts the surface by e^-7 · 0.1.
    EXPECT_NEAR(std::hypot(rho, p.z()), 0.4, 2e-4);
  }
}

TEST(WavySheet, IsARectangleWithStraightSides) {
  const TriMesh mesh = make_shape("wavy-sheet", {{"width", 3.0}, {"depth", 1.0}}, 0.1);
  const BoundingBox box = bounding_box(mesh);
  EXPECT_EQ(box.low.head<2>(), Eigen::Vector2d(-1.5, -0.5));
  EXPECT_EQ(box.high.head<2>(), Eigen::Vector2d(1.5, 0.5));
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d& p = mesh.point(v);
    const bool on_side = std::abs(p.x()) == 1.5 || std::abs(p.y()) == 0.5;
    EXPECT_EQ(mesh.is_boundary(v), on_side);
  }
}

TEST(MakeShape, IsTheSameEveryTime) {
  const TriMesh first = make_shape("double-torus", {}, 0.1),
                second = make_shape("double-torus", {}, 0.1);
  EXPECT_EQ(triangles_of(first), triangles_of(second));
  for (const auto v : first.vertices()) EXPECT_EQ(first.point(v), second.point(v));
}

TEST(MakeShape, ThrowsOnAnUnknownName) {
  EXPECT_THROW((void)make_shape("cube", {}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("sphere", {{"r", 1.0}}, 0.1), InvalidOption);
}

TEST(MakeShape, ThrowsOnAParameterOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)make_shape("sphere", {{"radius", 0.0}}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("sphere", {{"radius", nan}}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("ellipsoid", {{"b", -1.0}}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("torus", {{"R", 1.0}, {"r", 1.0}}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("double-torus", {{"r", 0.7}}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("tube", {{"length", 0.0}}, 0.1), InvalidOption);
  EXPECT_THROW((void)make_shape("wavy-sheet", {{"wavelength", 0.0}}, 0.1), InvalidOption);
}

TEST(MakeShape, ThrowsOnAnImpossibleEdgeLength) {
  for (const double edge_length : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)make_shape("sphere", {}, edge_length), InvalidOption);
  }
}

TEST(MakeShape, ThrowsOnEdgesTooShortOrTooLongForTheShape) {
  for (const auto& [name, euler, closed] : all_shapes) {
    EXPECT_THROW((void)make_shape(name, {}, 1e-6), InvalidOption) << name;
    EXPECT_THROW((void)make_shape(name, {}, 1e-300), InvalidOption) << name;
    EXPECT_THROW((void)make_shape(name, {}, 20.0), InvalidOption) << name;
  }
}

TEST(Junctions, AreClosedByHemispheresOrOpen) {
  struct Known {
    const char* name;
    int arms;
  };
  for (const Known& known : {Known{"y-junction", 3}, Known{"t-junction", 3}, Known{"x-junction", 4},
                             Known{"tetrapod", 4}, Known{"six-arm-junction", 6}}) {
    const MeshQuality closed = measure_quality(make_shape(known.name, {}, 0.25));
    EXPECT_EQ(closed.euler_characteristic, 2) << known.name;
    EXPECT_EQ(closed.boundary_loops, 0) << known.name;
    const TriMesh open = make_shape(known.name, {{"open", 1.0}}, 0.25);
    const MeshQuality cut = measure_quality(open);
    EXPECT_EQ(cut.euler_characteristic, 2 - known.arms) << known.name;
    EXPECT_EQ(cut.boundary_loops, known.arms) << known.name;
    EXPECT_EQ(cut.self_intersections, 0) << known.name;
    // Ends lie as far from the middle as asked for, on circles of the tube's radius.
    for (const auto v : open.vertices()) {
      if (!v.is_boundary()) continue;
      EXPECT_NEAR(open.point(v).norm(), std::hypot(4.0, 1.0), 0.02) << known.name;
    }
  }
  EXPECT_THROW(static_cast<void>(make_shape("y-junction", {{"open", 0.5}}, 0.25)), InvalidOption);
  EXPECT_THROW(static_cast<void>(make_shape("x-junction", {{"radius", 0.0}}, 0.25)), InvalidOption);
}

TEST(Junctions, HaveArmsAsThickAsTheirTubes) {
  const auto arm = [](std::vector<double> numbers) {
    return ShapeArgument{.name = "arm", .list = std::move(numbers)};
  };
  const TriMesh mesh = make_shape(
      "junction",
      {arm({1, 0, 0, 5, 10, 0}), arm({-1, 0, 0, 5, 5, 0}), arm({0, 1, 0, 5, 10, 0}), {"open", 1.0}},
      0.15);
  for (const auto v : mesh.vertices()) {
    if (!v.is_boundary()) continue;
    const bool is_thin = mesh.point(v).x() < -2.0;
    EXPECT_NEAR(mesh.point(v).norm(), std::hypot(5.0, is_thin ? 0.5 : 1.0), 0.02);
  }
  const auto refused = [&](const char* shape, const std::vector<ShapeArgument>& arguments) {
    EXPECT_THROW(static_cast<void>(make_shape(shape, arguments, 0.25)), InvalidOption);
  };
  refused("y-junction", {{"n", 10.0}, {"m", 10.0}});  // closed
  refused("y-junction", {{"n", 7.5}, {"open", 1.0}});
  refused("y-junction", {{"n", 2.0}, {"open", 1.0}});
  refused("y-junction", {{"m", 5.0}, {"open", 1.0}});
  refused("y-junction", {{"n", 5.0}, {"m", -5.0}, {"open", 1.0}});
  refused("junction", {arm({1, 0, 0, 5, 10, 0}), arm({-1, 0, 0}), {"open", 1.0}});
}

TEST(Junctions, TakeAnyListOfArms) {
  const auto arm = [](std::vector<double> numbers) {
    return ShapeArgument{.name = "arm", .list = std::move(numbers)};
  };
  const TriMesh open = make_shape(
      "junction", {arm({0, 0, 2}), arm({1, 0, -1, 6}), arm({-1, 0, 0, 5, 0.6}), {"open", 1.0}},
      0.15);
  const MeshQuality cut = measure_quality(open);
  EXPECT_EQ(cut.euler_characteristic, -1);
  EXPECT_EQ(cut.boundary_loops, 3);
  for (const auto v : open.vertices()) {
    if (!v.is_boundary()) continue;
    const Eigen::Vector3d& p = open.point(v);
    if (p.z() > 1.0) {
      EXPECT_NEAR(p.z(), 4.0, 1e-9);
    } else if (p.x() > 0.0) {
      EXPECT_NEAR(p.norm(), std::hypot(6.0, 1.0), 0.02);
    } else {
      EXPECT_NEAR(p.norm(), std::hypot(5.0, 0.6), 0.02);
    }
  }
  // The same as by name.
  const TriMesh tee =
      make_shape("junction", {arm({1, 0, 0}), arm({-1, 0, 0}), arm({0, 3, 0})}, 0.2);
  const TriMesh named = make_shape("t-junction", {}, 0.2);
  ASSERT_EQ(tee.n_vertices(), named.n_vertices());
  for (const auto v : tee.vertices()) EXPECT_EQ(tee.point(v), named.point(v));

  const auto refused = [&](const std::vector<ShapeArgument>& arguments) {
    EXPECT_THROW(static_cast<void>(make_shape("junction", arguments, 0.2)), InvalidOption);
  };
  refused({});
  refused({{"arm", 1.0}});
  refused({arm({1, 0})});
  refused({arm({1, 0, 0, 4, 1, 1})});
  refused({arm({0, 0, 0})});
  refused({arm({1, 0, 0, -4})});
  refused({arm({1, 0, 0}), arm({2, 0, 0.1})});
  refused({arm({1, 0, 0}), arm({0, 1, 0, 0.5}), {"open", 1.0}});
  refused({arm({1, 0, 0}), {.name = "radius", .list = {1, 2}}});
}

TEST(Networks, HaveTheGenusOfTheirGraph) {
  // Twice the nodes less the edges of a cell.
  struct Known {
    const char* name;
    int euler_characteristic;
  };
  for (const Known& known : {Known{"cubic-network", -4}, Known{"diamond-network", -16},
                             Known{"honeycomb-network", -2}}) {
    const TriMesh mesh = make_shape(known.name, {}, 0.4);
    EXPECT_EQ(measure_quality(mesh).euler_characteristic, known.euler_characteristic) << known.name;
    EXPECT_EQ(measure_quality(mesh).components, 1) << known.name;
    EXPECT_TRUE(mesh.lattice.is_periodic()) << known.name;
  }
}

}  // namespace
}  // namespace trivalent::remesh
