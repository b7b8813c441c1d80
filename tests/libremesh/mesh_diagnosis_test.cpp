#include "trivalent/remesh/mesh_diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh_fixtures.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::remesh {
namespace {

using testing_support::tetrahedron;
using testing_support::triangular_sheet;

/// The only finding, if it is of the kind and count expected.
ProblemPlace only_place(const MeshDiagnosis& diagnosis, Problem problem, std::size_t count = 1) {
  EXPECT_EQ(diagnosis.findings.size(), 1u);
  if (diagnosis.findings.empty()) return {};
  EXPECT_EQ(diagnosis.findings[0].problem, problem) << name_of(diagnosis.findings[0].problem);
  EXPECT_EQ(diagnosis.findings[0].count, count);
  return diagnosis.findings[0].first.front();
}

TEST(Diagnose, FindsNothingWrongWithSoundMeshes) {
  const MeshDiagnosis closed = diagnose(soup_of(tetrahedron()));
  EXPECT_TRUE(closed.findings.empty());
  EXPECT_TRUE(closed.is_oriented_manifold());
  EXPECT_EQ(closed.components, 1);
  EXPECT_EQ(closed.boundary_edges, 0);
  const MeshDiagnosis open = diagnose(soup_of(triangular_sheet(3, 2)));
  EXPECT_TRUE(open.findings.empty());
  EXPECT_EQ(open.points, 12);
  EXPECT_EQ(open.faces, 12);
  EXPECT_EQ(open.boundary_edges, 10);
}

TEST(Diagnose, FindsIsolatedPoints) {
  TriangleSoup soup = soup_of(tetrahedron());
  soup.points.emplace_back(7, 8, 9);
  const ProblemPlace place = only_place(diagnose(soup), Problem::isolated_point);
  EXPECT_EQ(place.elements, std::vector{4});
  EXPECT_EQ(place.position, Eigen::Vector3d(7, 8, 9));
}

TEST(Diagnose, FindsPointsFarOff) {
  TriangleSoup soup = soup_of(triangular_sheet(3, 2));
  soup.points[5].z() = 50.0;
  EXPECT_TRUE(diagnose(soup).findings.empty());
  soup.points[5].z() = 1e11;
  EXPECT_EQ(only_place(diagnose(soup), Problem::far_point).elements, std::vector{5});
}

TEST(Diagnose, FindsCoincidentPoints) {
  // Two triangles that touch along an edge without sharing its points.
  const TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                          {{0, 1, 2}, {3, 4, 5}},
                          {}};
  const MeshDiagnosis diagnosis = diagnose(soup);
  EXPECT_EQ(only_place(diagnosis, Problem::coincident_point, 2).elements, std::vector{3});
  EXPECT_EQ(diagnosis.components, 2);
}

TEST(Diagnose, FindsRepeatedFaces) {
  TriangleSoup soup = soup_of(triangular_sheet(1, 1));
  soup.triangles.push_back({soup.triangles[0][1], soup.triangles[0][0], soup.triangles[0][2]});
  const MeshDiagnosis diagnosis = diagnose(soup);
  ASSERT_FALSE(diagnosis.findings.empty());
  EXPECT_EQ(diagnosis.findings[0].problem, Problem::repeated_face);
  EXPECT_EQ(diagnosis.findings[0].first[0].elements, std::vector{2});
}

TEST(Diagnose, FindsFlatFaces) {
  const TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  EXPECT_EQ(only_place(diagnose(soup), Problem::flat_face).elements, std::vector{0});
}

TEST(Diagnose, FindsCrowdedEdges) {
  const TriangleSoup soup{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}},
                          {}};
  const MeshDiagnosis diagnosis = diagnose(soup);
  EXPECT_EQ(diagnosis.findings.front().problem, Problem::crowded_edge);
  EXPECT_EQ(diagnosis.findings.front().first[0].elements, (std::vector{0, 1}));
  EXPECT_FALSE(diagnosis.is_oriented_manifold());
  EXPECT_EQ(diagnosis.components, 1);
}

TEST(Diagnose, FindsMisorientedEdges) {
  TriangleSoup soup = soup_of(tetrahedron());
  std::swap(soup.triangles[2][0], soup.triangles[2][1]);
  const MeshDiagnosis diagnosis = diagnose(soup);
  EXPECT_EQ(only_place(diagnosis, Problem::misoriented_edge, 3).elements, (std::vector{0, 2}));
  EXPECT_FALSE(diagnosis.is_oriented_manifold());
}

TEST(Diagnose, FindsPinchedVertices) {
  const TriangleSoup soup{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}, {}};
  const MeshDiagnosis diagnosis = diagnose(soup);
  EXPECT_EQ(only_place(diagnosis, Problem::pinched_vertex).elements, std::vector{0});
  EXPECT_FALSE(diagnosis.is_oriented_manifold());
}

TEST(Diagnose, FindsBoundaryLoops) {
  TriangleSoup soup = soup_of(testing_support::icosahedron());
  // Two faces that share no vertex.
  std::erase(soup.triangles, std::array{0, 11, 5});
  std::erase(soup.triangles, std::array{6, 2, 10});
  std::erase(soup.triangles, std::array{8, 6, 7});
  const MeshDiagnosis diagnosis = diagnose(soup);
  EXPECT_EQ(diagnosis.boundary_edges, 9);
  EXPECT_EQ(diagnosis.boundary_loops, 2);
  ASSERT_EQ(diagnosis.first_boundaries.size(), 2u);
  EXPECT_EQ(diagnosis.first_boundaries[0].elements, (std::vector{0, 5}));
}

TEST(FindCrossingFaces, NamesTheFirstPairs) {
  // A triangle through the middle of two others that share an edge.
  TriangleSoup soup{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 2, -1}, {3, 2, -1}, {2, 2, 1}},
                    {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}},
                    {}};
  const Finding finding = find_crossing_faces(soup);
  EXPECT_EQ(finding.problem, Problem::crossing_faces);
  EXPECT_EQ(finding.count, 2u);
  EXPECT_EQ(finding.first[0].elements, (std::vector{0, 2}));
  EXPECT_EQ(finding.first[1].elements, (std::vector{1, 2}));
  EXPECT_EQ(finding.first[1].position, Eigen::Vector3d(0, 0, 0));
  // Neither a repeated face nor a flat one changes that.
  soup.triangles.push_back({1, 2, 0});
  soup.triangles.push_back({4, 6, 4});
  EXPECT_EQ(find_crossing_faces(soup).count, 2u);
}

/// Triangles around the origin, each in a plane of its own through it: each crosses all others.
TriangleSoup fan_of_crossing_faces(int n_faces) {
  TriangleSoup soup;
  for (int k = 0; k < n_faces; ++k) {
    const double angle = std::numbers::pi * k / n_faces;
    const Eigen::Vector3d side(std::cos(angle), std::sin(angle), 0.0);
    for (const auto& [along, up] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {0.0, 1.0 + angle}}) {
      soup.points.push_back(along * side + Eigen::Vector3d(0.0, 0.0, up));
    }
    soup.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  return soup;
}

TEST(FindCrossingFaces, CountsUpToALimit) {
  const Finding few = find_crossing_faces(fan_of_crossing_faces(100));
  EXPECT_EQ(few.count, 100u * 99u / 2u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(few.first[static_cast<std::size_t>(k)].elements, (std::vector{0, k + 1}));
  }
  // Two million pairs.
  EXPECT_EQ(find_crossing_faces(fan_of_crossing_faces(2001)).count,
            static_cast<std::size_t>(max_crossing_pairs));
}

TEST(FindCrossingFaces, SeesThatTornFacesOnlyTouch) {
  const TriangleSoup whole = soup_of(testing_support::icosahedron());
  TriangleSoup torn;
  for (const auto& triangle : whole.triangles) {
    const int first = static_cast<int>(torn.points.size());
    for (const int v : triangle) torn.points.push_back(whole.points[static_cast<std::size_t>(v)]);
    torn.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(find_crossing_faces(torn).count, 0u);
}

TEST(Diagnose, ShowsOnlyTheFirstPlaces) {
  TriangleSoup soup = soup_of(tetrahedron());
  for (int k = 0; k < 1000; ++k) soup.points.emplace_back(k, 7, 7);
  const MeshDiagnosis diagnosis = diagnose(soup);
  EXPECT_EQ(diagnosis.findings.front().count, 1000u);
  EXPECT_EQ(diagnosis.findings.front().first.size(), 5u);
}

TEST(Diagnose, SaysWhatMakeMeshWillRefuse) {
  int refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TRIVALENT_MESHES)) {
    const auto path = entry.path();
    const TriangleSoup soup = triangulate(read_polygon_soup(path));
    bool accepted = true;
    try {
      (void)make_mesh(soup.points, soup.triangles);
    } catch (const InvalidMesh&) {
      accepted = false;
      ++refused;
    }
    EXPECT_EQ(diagnose(soup).is_oriented_manifold(), accepted) << path;
  }
  EXPECT_GT(refused, 0);
}

TEST(FindCrossingFaces, FindsTheSameHoweverSpaceIsCut) {
  const TriangleSoup sphere = soup_of(make_shape("sphere", {}, 0.03));
  TriangleSoup two = sphere;  // large enough for several slabs, across the longest side
  const auto n = static_cast<int>(sphere.points.size());
  for (const Eigen::Vector3d& p : sphere.points) two.points.emplace_back(p.x() + 1.0, p.y(), p.z());
  for (const auto& [a, b, c] : sphere.triangles) two.triangles.push_back({a + n, b + n, c + n});
  const Finding found = find_crossing_faces(two);
  EXPECT_GT(found.count, 200u);
  for (const int axis : {1, 2}) {
    TriangleSoup stretched = two;
    for (Eigen::Vector3d& p : stretched.points) p[axis] *= 4.0;  // without rounding
    const Finding again = find_crossing_faces(stretched);
    EXPECT_EQ(again.count, found.count);
    for (std::size_t i = 0; i < found.first.size(); ++i) {
      EXPECT_EQ(again.first[i].elements, found.first[i].elements);
    }
  }
}

}  // namespace
}  // namespace trivalent::remesh
