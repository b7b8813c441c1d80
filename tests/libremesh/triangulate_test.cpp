#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {
namespace {

using Notes = std::vector<std::string>;
using Triangles = std::vector<std::array<int, 3>>;

PolygonSoup polygons(const std::vector<Eigen::Vector3d>& points,
                     const std::vector<std::vector<int>>& faces) {
  PolygonSoup soup;
  soup.points = points;
  for (const std::vector<int>& face : faces) {
    soup.corners.insert(soup.corners.end(), face.begin(), face.end());
    soup.ends.push_back(soup.corners.size());
  }
  return soup;
}

TriangleSoup split(const std::vector<Eigen::Vector3d>& points) {
  PolygonSoup soup;
  soup.points = points;
  for (std::size_t v = 0; v < points.size(); ++v) soup.corners.push_back(static_cast<int>(v));
  soup.ends.push_back(points.size());
  return triangulate(soup);
}

/// Area if all triangles look along +z, less if some overlap.
double area_along_z(const TriangleSoup& soup) {
  double area = 0.0;
  for (const auto& [a, b, c] : soup.triangles) {
    const auto at = [&](int v) { return soup.points[static_cast<std::size_t>(v)]; };
    const double twice = (at(b) - at(a)).cross(at(c) - at(a)).z();
    EXPECT_GE(twice, 0.0);
    area += 0.5 * twice;
  }
  return area;
}

TEST(Triangulate, CutsQuadsAlongTheShorterDiagonal) {
  const TriangleSoup soup = split({{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, -1, 0}});
  EXPECT_EQ(soup.notes, Notes{"split 1 quad"});
  EXPECT_EQ(soup.triangles, (std::vector<std::array<int, 3>>{{1, 2, 3}, {1, 3, 0}}));
}

TEST(Triangulate, CutsConcaveQuadsInside) {
  // The shorter diagonal, 1-3, lies outside.
  const TriangleSoup soup = split({{0, 0, 0}, {4, -0.5, 0}, {1, 0, 0}, {4, 0.5, 0}});
  EXPECT_NEAR(area_along_z(soup), 0.5, 1e-15);
}

TEST(Triangulate, FillsConcavePolygonsWithoutOverlap) {
  // An L, a comb, and a square with a square hole joined by a cut there and back.
  EXPECT_NEAR(
      area_along_z(split({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}})), 5.0,
      1e-14);
  EXPECT_NEAR(area_along_z(split({{0, 0, 0},
                                  {5, 0, 0},
                                  {5, 3, 0},
                                  {4, 3, 0},
                                  {4, 1, 0},
                                  {3, 1, 0},
                                  {3, 3, 0},
                                  {2, 3, 0},
                                  {2, 1, 0},
                                  {1, 1, 0},
                                  {1, 3, 0},
                                  {0, 3, 0}})),
              11.0, 1e-14);
  EXPECT_NEAR(area_along_z(split({{0, 0, 0},
                                  {3, 0, 0},
                                  {3, 3, 0},
                                  {0, 3, 0},
                                  {0, 0, 0},
                                  {1, 1, 0},
                                  {1, 2, 0},
                                  {2, 2, 0},
                                  {2, 1, 0},
                                  {1, 1, 0}})),
              8.0, 1e-14);
}

TEST(Triangulate, FansConvexPolygons) {
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < 5000; ++k)
    points.emplace_back(std::cos(k * 2e-4 * 2.0 * std::numbers::pi),
                        std::sin(k * 2e-4 * 2.0 * std::numbers::pi), 0);
  EXPECT_EQ(split(points).triangles.size(), 4998u);
}

TEST(Triangulate, FillsPolygonsThatCrossThemselvesSomehow) {
  std::vector<Eigen::Vector3d> pentagram;
  for (int k = 0; k < 5; ++k) {
    const double angle = 0.8 * k * std::numbers::pi;
    pentagram.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  EXPECT_EQ(split(pentagram).triangles.size(), 3u);
}

TEST(Triangulate, EndsOnPolygonsThatComeBackToTheirCorners) {
  // Every cut leads along an edge, and so does the cut to a point in its middle.
  const TriangleSoup soup = split({{0, 0, 0}, {2, 0, 5}, {2, 0, 5}, {1, 0.5, 0}, {1, 0.5, 0}});
  EXPECT_LT(soup.triangles.size(), 30u);
}

TEST(Triangulate, RefusesConcavePolygonsOfManyCorners) {
  std::vector<Eigen::Vector3d> comb;
  for (int k = 0; k < 2000; ++k) comb.emplace_back(k, k % 2, 0);
  comb.emplace_back(1000, 100, 0);
  EXPECT_THROW((void)split(comb), InvalidMesh);
}

TEST(Triangulate, DropsTrianglesThatRepeatACornerAndSaysSo) {
  // Found by fuzzing: a corner that comes again, but not next to itself.
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.corners = {0, 1, 0, 2};
  soup.ends = {4};
  const TriangleSoup result = triangulate(soup);
  for (const auto& [a, b, c] : result.triangles) EXPECT_TRUE(a != b && b != c && c != a);
  EXPECT_LT(result.triangles.size(), 2u);
  EXPECT_NE(result.notes.front().find("that repeated a corner"), std::string::npos);
}

TEST(Triangulate, DropsDegenerateFacesAndSaysSo) {
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.corners = {0, 1, 2, 0, 0, 1, 0, 0, 0, 1, 1, 2};
  soup.ends = {3, 5, 7, 12};
  const TriangleSoup result = triangulate(soup);
  EXPECT_EQ(result.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(result.notes, (Notes{"merged 3 repeated corners of faces",
                                 "dropped 2 faces with fewer than 3 corners"}));
}

// ---- diagonals that exist already --------------------------------------------------------------

/// How many triangles have the edge a-b.
std::size_t count_of(const TriangleSoup& soup, int a, int b) {
  return static_cast<std::size_t>(std::ranges::count_if(soup.triangles, [&](const auto& t) {
    return std::ranges::count(t, a) + std::ranges::count(t, b) == 2;
  }));
}

/// The mesh of the triangles, which must be one oriented manifold surface.
TriMesh expect_one_surface(const TriangleSoup& soup) {
  TriMesh mesh;
  EXPECT_NO_THROW(mesh = make_mesh(soup.points, soup.triangles));
  EXPECT_EQ(find_components(mesh).parts.size(), 1u);
  return mesh;
}

TEST(Triangulate, KeepsQuadsThatShareTwoEdgesTogether) {
  // The shorter diagonal of both is the same.
  const TriangleSoup soup =
      triangulate(polygons({{0, 0, 0}, {0.5, 0, 0.2}, {1, 0, 0}, {0.5, 2, 0}, {0.5, -2, 0}},
                           {{0, 1, 2, 3}, {0, 4, 2, 1}}));
  const TriMesh mesh = expect_one_surface(soup);
  EXPECT_EQ(mesh.n_vertices(), 5u);
  EXPECT_EQ(mesh.n_faces(), 4u);
  EXPECT_EQ(soup.notes,
            (Notes{"split 2 quads",
                   "split 1 face along other diagonals, because an edge was there already"}));
}

TEST(Triangulate, AvoidsTheSidesOfFacesToCome) {
  // The shorter diagonal of the quad, 0-2, is a side of the two triangles behind it.
  const TriangleSoup soup =
      triangulate(polygons({{-1, 0, 0}, {0, -2, 0.3}, {1, 0, 0}, {0, 2, 0.3}, {0, 0, -1}},
                           {{0, 1, 2, 3}, {0, 2, 1}, {0, 4, 2}, {0, 3, 4}, {4, 3, 2}}));
  EXPECT_EQ(expect_one_surface(soup).n_faces(), 6u);
}

TEST(Triangulate, AddsAPointWhereBothDiagonalsExist) {
  // Two fins, along the two diagonals of the quad, whose edges have one triangle each.
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0},   {1, 0, 0.3},  {1, 1, 0},
                                               {0, 1, 0.3}, {0.5, -1, 1}, {0.5, 2, 1}};
  const PolygonSoup soup = polygons(points, {{0, 1, 2, 3}, {0, 2, 4}, {1, 3, 5}});
  const TriangleSoup result = triangulate(soup);
  EXPECT_EQ(result.points.size(), points.size() + 1);
  EXPECT_EQ(result.triangles.size(), 4u + 2u);
  EXPECT_EQ(count_of(result, 0, 2), 1u);
  EXPECT_EQ(count_of(result, 1, 3), 1u);
  EXPECT_NE(result.notes.back().find("added 1 point within faces"), std::string::npos);
}

TEST(Triangulate, AvoidsEdgesInFacesOfManyCorners) {
  // Two fins over a hexagon; the fan from corner 0 would repeat an edge of the first.
  std::vector<Eigen::Vector3d> points;
  std::vector<int> lid;
  for (int k = 0; k < 6; ++k) {
    points.emplace_back(std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3), 0);
    lid.push_back(k);
  }
  points.emplace_back(0, 0, 1);
  const TriangleSoup result = triangulate(polygons(points, {lid, {0, 2, 6}, {3, 5, 6}}));
  EXPECT_EQ(result.points.size(), points.size());
  EXPECT_EQ(result.triangles.size(), 4u + 2u);
  EXPECT_EQ(count_of(result, 0, 2), 1u);
  EXPECT_EQ(count_of(result, 3, 5), 1u);
}

TEST(Triangulate, SeesEdgesBetweenOtherPointsAtTheSamePositions) {
  const TriangleSoup soup = triangulate(polygons({{0, 0, 0},
                                                  {0.5, 0, 0.2},
                                                  {1, 0, 0},
                                                  {0.5, 2, 0},
                                                  {0, 0, 0},
                                                  {0.5, -2, 0},
                                                  {1, 0, 0},
                                                  {0.5, 0, 0.2}},
                                                 {{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(soup.triangles[2], (std::array<int, 3>{5, 6, 7}));
}

TEST(Triangulate, CutsRepeatedPolygonsAlike) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, -1, 0}};
  const TriangleSoup soup = triangulate(polygons(points, {{0, 1, 2, 3}, {2, 1, 0, 3}}));
  EXPECT_EQ(soup.triangles, (Triangles{{1, 2, 3}, {1, 3, 0}, {1, 0, 3}, {1, 3, 2}}));
}

}  // namespace
}  // namespace trivalent::remesh
