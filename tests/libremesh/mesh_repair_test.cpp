#include "trivalent/remesh/mesh_repair.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_diagnosis.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::remesh {
namespace {

using testing_support::icosahedron;
using testing_support::is_closed;
using testing_support::octahedron;
using testing_support::signed_volume;
using testing_support::triangular_sheet;

using Notes = std::vector<std::string>;

/// Adds a mesh with points of its own.
void append(TriangleSoup& soup, const TriMesh& mesh, const Eigen::Vector3d& shift) {
  const int first = static_cast<int>(soup.points.size());
  for (const auto v : mesh.vertices()) soup.points.push_back(mesh.point(v) + shift);
  for (const auto& [a, b, c] : triangles_of(mesh)) {
    soup.triangles.push_back({first + a, first + b, first + c});
  }
}

/// Every face with three points of its own, as in an STL file.
TriangleSoup torn_apart(const TriangleSoup& soup) {
  TriangleSoup torn;
  for (const auto& triangle : soup.triangles) {
    const int first = static_cast<int>(torn.points.size());
    for (const int v : triangle) torn.points.push_back(soup.points[static_cast<std::size_t>(v)]);
    torn.triangles.push_back({first, first + 1, first + 2});
  }
  return torn;
}

void expect_icosahedron(const RepairResult& result, const Notes& notes) {
  EXPECT_EQ(result.notes, notes);
  EXPECT_EQ(result.mesh.n_vertices(), 12u);
  EXPECT_EQ(result.mesh.n_faces(), 20u);
  EXPECT_TRUE(is_closed(result.mesh));
  EXPECT_NEAR(signed_volume(result.mesh), signed_volume(icosahedron()), 1e-13);
}

TEST(Repair, LeavesASoundMeshAlone) {
  const TriangleSoup soup = soup_of(icosahedron());
  for (const RepairMethod method : {RepairMethod::none, RepairMethod::safe}) {
    const RepairResult result = repair(soup, {.method = method});
    expect_icosahedron(result, {});
    EXPECT_EQ(triangles_of(result.mesh), soup.triangles);
  }
}

TEST(Repair, JoinsFacesThatWereTornApart) {
  expect_icosahedron(repair(torn_apart(soup_of(icosahedron()))),
                     {"joined 48 coincident points", "dropped 48 isolated points"});
}

TEST(Repair, TurnsFacesThatDisagree) {
  TriangleSoup soup = soup_of(icosahedron());
  for (const std::size_t f : {2, 3, 11, 17}) std::swap(soup.triangles[f][0], soup.triangles[f][1]);
  expect_icosahedron(repair(soup), {"turned 4 disagreeing faces"});
}

TEST(Repair, TurnsClosedSurfacesThatAreInsideOut) {
  TriangleSoup soup = soup_of(icosahedron());
  for (auto& triangle : soup.triangles) std::swap(triangle[0], triangle[1]);
  expect_icosahedron(repair(soup), {"turned 1 inside-out component"});
}

TEST(Repair, DropsRepeatedAndDegenerateFaces) {
  TriangleSoup soup = soup_of(icosahedron());
  soup.triangles.push_back(soup.triangles[7]);
  soup.triangles.push_back({soup.triangles[7][1], soup.triangles[7][0], soup.triangles[7][2]});
  expect_icosahedron(repair(soup), {"dropped 2 repeated faces"});
  // A sliver between a point and its copy, which stand on open edges.
  TriangleSoup sheet = soup_of(triangular_sheet(1, 1));
  sheet.points.push_back(sheet.points[0]);
  sheet.triangles.push_back({0, 4, 1});
  EXPECT_EQ(repair(sheet).notes, (Notes{"joined 1 coincident point", "dropped 1 degenerate face",
                                        "dropped 1 isolated point"}));
}

TEST(Repair, SeparatesSolidsThatTouchInAnEdge) {
  // Two cubes along a common edge of four faces; each stays closed.
  TriangleSoup soup;
  append(soup, testing_support::cube(), {0, 0, 0});
  append(soup, testing_support::cube(), {1, 1, 0});
  const RepairResult result = repair(torn_apart(soup));
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_EQ(quality.components, 2);
  EXPECT_EQ(quality.boundary_loops, 0);
  EXPECT_EQ(quality.euler_characteristic, 4);
  EXPECT_NEAR(signed_volume(result.mesh), 2.0, 1e-15);
}

TEST(Repair, SeparatesSurfacesThatTouchInAPoint) {
  TriangleSoup soup = soup_of(octahedron());
  append(soup, octahedron(), {2, 0, 0});
  // Point 0 of the first at (1, 0, 0) is point 3 of the second.
  for (auto& triangle : soup.triangles) {
    for (int& v : triangle) v = v == 9 ? 0 : v;
  }
  const RepairResult result = repair(soup);
  EXPECT_EQ(result.notes,
            (Notes{"split points where surfaces meet: added 1 point", "dropped 1 isolated point"}));
  EXPECT_EQ(result.mesh.n_vertices(), 12u);
  EXPECT_EQ(euler_characteristic(result.mesh), 4);
}

TEST(Repair, CutsOffFins) {
  TriangleSoup soup = soup_of(testing_support::cube());
  soup.points.emplace_back(-1, -1, 0.5);
  // Attached to the cube's edge from 0 to 4.
  soup.triangles.push_back({0, 4, 8});
  const RepairResult result = repair(soup);
  EXPECT_EQ(measure_quality(result.mesh).components, 2);
  EXPECT_EQ(result.mesh.n_faces(), 13u);
  const RepairResult largest = repair(soup, {.components = ComponentPolicy::keep_largest});
  EXPECT_TRUE(is_closed(largest.mesh));
  EXPECT_NEAR(signed_volume(largest.mesh), 1.0, 1e-15);
}

TEST(Repair, RemovesFlatFacesWithoutChangingTheShape) {
  // Point 4 lies on the edge from 0 to 1 of a tetrahedron: one face there is flat.
  const TriangleSoup soup{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                          {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {1, 2, 3}, {0, 3, 2}},
                          {}};
  const RepairResult result = repair(soup);
  EXPECT_EQ(result.notes, Notes{"removed 1 flat face"});
  EXPECT_TRUE(is_closed(result.mesh));
  EXPECT_GT(measure_quality(result.mesh).smallest_angle, 0.1);
  EXPECT_NEAR(signed_volume(result.mesh), 8.0 / 6.0, 1e-15);
}

TEST(Repair, LeavesAFlatFaceThatHoldsTwoOthersTogether) {
  // Without the flat face, the other two would meet in point 2 only.
  const TriangleSoup soup{{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {2, -1, 0}, {0, -1, 0}},
                          {{0, 1, 2}, {2, 1, 3}, {0, 2, 4}},
                          {}};
  const RepairResult result = repair(soup);
  EXPECT_EQ(result.notes, Notes{"left 1 flat face"});
  EXPECT_TRUE(diagnose(soup_of(result.mesh)).is_oriented_manifold());
}

TEST(Repair, FillsHolesIfWanted) {
  TriangleSoup soup = soup_of(icosahedron());
  soup.triangles.erase(soup.triangles.begin() + 3, soup.triangles.begin() + 5);
  EXPECT_FALSE(is_closed(repair(soup).mesh));
  const RepairResult filled = repair(soup, {.holes = HolePolicy::fill});
  expect_icosahedron(filled, {"filled 1 hole"});
}

TEST(Repair, FillsHolesWhoseChordsExist) {
  // The boundary runs around three flaps, whose ears would be cut along edges that have two faces.
  const TriangleSoup star{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -2, 1}, {5, 3, 1}, {-1, 3, 1}},
                          {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}},
                          {}};
  const RepairResult result = repair(star, {.holes = HolePolicy::fill});
  EXPECT_TRUE(is_closed(result.mesh));
  EXPECT_EQ(euler_characteristic(result.mesh), 2);
}

TEST(Repair, TakesAVanishingDetailForAPoint) {
  // A tetrahedron with a corner cut off so closely that squares of its edges are no numbers.
  constexpr double e = 1e-170;
  const TriangleSoup cut{
      {{e, 0, 0}, {0, e, 0}, {0, 0, e}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {{0, 1, 2}, {3, 4, 1}, {3, 1, 0}, {4, 5, 2}, {4, 2, 1}, {5, 3, 0}, {5, 0, 2}, {3, 5, 4}},
      {}};
  const RepairResult result = repair(cut);
  ASSERT_FALSE(result.notes.empty());
  EXPECT_EQ(result.notes[0], "set to zero 3 vanishing coordinates");
  EXPECT_EQ(result.mesh.n_vertices(), 4u);
  EXPECT_EQ(result.mesh.n_faces(), 4u);
  EXPECT_NEAR(std::abs(signed_volume(result.mesh)), 1.0 / 6.0, 1e-15);
}

TEST(Repair, TakesTheSizeFromTheFacesAlone) {
  TriangleSoup soup = soup_of(icosahedron());
  soup.points.emplace_back(1e80, 0.0, 0.0);
  const RepairResult result = repair(soup);
  EXPECT_EQ(result.notes, Notes{"dropped 1 isolated point"});
  EXPECT_EQ(signed_volume(result.mesh), signed_volume(icosahedron()));
}

TEST(Repair, WrapsWhatNothingElseMends) {
  // Two spheres' worth of faces that cross each other, torn apart.
  TriangleSoup soup = soup_of(icosahedron());
  append(soup, icosahedron(), {1.5, 0.3, 0.2});
  const RepairOptions options{.method = RepairMethod::wrap, .wrap_alpha = 0.5, .wrap_offset = 0.02};
  const RepairResult result = repair(torn_apart(soup), options);
  const MeshQuality quality = measure_quality(result.mesh);
  EXPECT_EQ(quality.components, 1);
  EXPECT_EQ(quality.euler_characteristic, 2);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_EQ(result.offset, 0.02);
  EXPECT_GT(signed_volume(result.mesh), signed_volume(icosahedron()));
  EXPECT_EQ(triangles_of(repair(torn_apart(soup), options).mesh), triangles_of(result.mesh));
}

TEST(Repair, WrapsPoints) {
  TriangleSoup soup = soup_of(icosahedron());
  soup.triangles.clear();
  const RepairResult result =
      repair(soup, {.method = RepairMethod::wrap, .wrap_alpha = 3.0, .wrap_offset = 0.1});
  EXPECT_TRUE(is_closed(result.mesh));
  EXPECT_EQ(euler_characteristic(result.mesh), 2);
}

double edge_length_of_net(const TriMesh&) { return 0.7; }

TEST(Repair, KeepsTheSidesOfAWrappedSheetTwoEdgesApart) {
  const TriangleSoup sheet = soup_of(triangular_sheet(8, 8));  // in the plane z = 0
  const RepairResult result =
      repair(sheet, {.method = RepairMethod::wrap, .edge_length_on = edge_length_of_net});
  EXPECT_EQ(result.offset, 0.7);
  const BoundingBox box = bounding_box(soup_of(result.mesh).points);
  EXPECT_NEAR(box.high.z(), 0.7, 0.07);
  EXPECT_NEAR(box.low.z(), -0.7, 0.07);
  EXPECT_EQ(result.notes.back(), "its distance is one edge, as its sides would meet otherwise");
}

TEST(Repair, WrapsCloselyWhatIsThickOrIsToBe) {
  const auto offset = [](const TriMesh& mesh, std::optional<double> wanted) {
    return repair(soup_of(mesh), {.method = RepairMethod::wrap,
                                  .wrap_alpha = 0.3,
                                  .wrap_offset = wanted,
                                  .edge_length_on = edge_length_of_net})
        .offset;
  };
  TriMesh ball = icosahedron();
  scale(ball, 3.0);
  EXPECT_EQ(offset(ball, std::nullopt), 0.01);
  EXPECT_EQ(offset(triangular_sheet(8, 8), 0.05), 0.05);
}

TEST(Repair, MendsEveryRealMesh) {
  for (const auto* name :
       {"boeing.off", "cow.off", "elephant-with-holes.off", "mask_cone.off", "pig.stl",
        "polygon_mesh.off", "blobby-shuffled.off", "degtri_sliding.off"}) {
    const auto path = std::filesystem::path(TRIVALENT_MESHES) / name;
    const RepairResult result = repair(triangulate(read_polygon_soup(path)));
    const MeshDiagnosis diagnosis = diagnose(soup_of(result.mesh));
    EXPECT_TRUE(diagnosis.is_oriented_manifold()) << name;
  }
}

TEST(Repair, ThrowsWhenNotAllowedToMend) {
  TriangleSoup soup = soup_of(icosahedron());
  std::swap(soup.triangles[2][0], soup.triangles[2][1]);
  EXPECT_THROW((void)repair(soup, {.method = RepairMethod::none}), InvalidMesh);
}

TEST(Repair, ThrowsOnNothing) {
  for (const RepairMethod method : {RepairMethod::none, RepairMethod::safe, RepairMethod::wrap}) {
    EXPECT_THROW((void)repair({}, {.method = method}), InvalidMesh);
  }
}

TEST(Repair, ThrowsOnPointsAloneUnlessTheyAreWrapped) {
  TriangleSoup soup = soup_of(icosahedron());
  soup.triangles.clear();
  EXPECT_THROW((void)repair(soup), InvalidMesh);
}

TEST(Repair, ThrowsOnAMoebiusStrip) {
  // Five triangles around, glued with a twist.
  const TriangleSoup strip{{{0, 0, 0}, {1, 0, 1}, {2, 1, 0}, {1, 2, 1}, {0, 1, 0}},
                           {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}},
                           {}};
  EXPECT_THROW((void)repair(strip), InvalidMesh);
}

TEST(Repair, ThrowsOnWrapLengthsOutOfRange) {
  const TriangleSoup soup = soup_of(icosahedron());
  EXPECT_THROW((void)repair(soup, {.method = RepairMethod::wrap, .wrap_alpha = 0.0}),
               InvalidOption);
  EXPECT_THROW((void)repair(soup, {.method = RepairMethod::wrap, .wrap_offset = -1.0}),
               InvalidOption);
}

}  // namespace
}  // namespace trivalent::remesh
