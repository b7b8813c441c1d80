#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "mesh_file_texts.h"

namespace trivalent::remesh {
namespace {

std::string text_stl() {
  std::string text = "solid a name # 7\n";
  for (const auto& face : tetrahedron_faces) {
    text += "  facet normal nan nan nan\n    outer loop\n";
    for (const int v : face) {
      const auto& [x, y, z] = tetrahedron_points[static_cast<std::size_t>(v)];
      text += concat("      vertex ", x, ' ', y, ' ', z, '\n');
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a name\n";
}

std::string binary_stl(std::string_view header) {
  std::string bytes(header);
  bytes.resize(80, ' ');
  bytes += bytes_of(std::uint32_t{4});
  for (const auto& face : tetrahedron_faces) {
    bytes += std::string(12, '\0');
    for (const int v : face) {
      for (const float x : tetrahedron_points[static_cast<std::size_t>(v)]) bytes += bytes_of(x);
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

const Notes welded = {"welded 12 corners into 4 vertices"};

TEST(ReadStl, TellsTextFromBinary) {
  expect_tetrahedron(parse_polygon_soup(text_stl(), "a.stl"), welded);
  expect_tetrahedron(parse_polygon_soup(binary_stl("made by hand"), "a.stl"), welded);
  expect_tetrahedron(parse_polygon_soup(binary_stl("solid but binary"), "a.stl"), welded);
  std::string shouted = text_stl();
  for (char& c : shouted) c = c == 'e' ? 'E' : c;
  expect_tetrahedron(parse_polygon_soup(shouted, "a.stl"), welded);
}

TEST(ReadStl, JoinsSolidsAndSaysSo) {
  const std::string text = text_stl() + text_stl();
  const PolygonSoup soup = parse_polygon_soup(text, "a.stl");
  EXPECT_EQ(soup.ends.size(), 8u);
  EXPECT_EQ(soup.notes, (Notes{"joined 2 solids", "welded 24 corners into 4 vertices"}));
}

TEST(ReadStl, WeldsNegativeZeroWithZero) {
  std::string text = text_stl();
  text.replace(text.find("vertex 0 0 0"), 12, "vertex -0 0 0");
  expect_tetrahedron(parse_polygon_soup(text, "a.stl"), welded);
}

TEST(ReadStl, NamesThePlaceOfAnError) {
  const std::string binary = binary_stl("");
  expect_refusal(binary.substr(0, binary.size() - 1), "a.stl", "declares 4 triangles");
  expect_refusal(binary.substr(0, 50), "a.stl", "too short");
  std::string not_finite = binary;
  not_finite.replace(84 + 50 + 12, 4, bytes_of(std::nanf("")));
  expect_refusal(not_finite, "a.stl", "triangle 1 (counted from 0)");
  std::string bomb = binary;
  bomb.replace(80, 4, "\xff\xff\xff\xff");
  expect_refusal(bomb, "a.stl", "declares 4294967295 triangles");
  std::string text = text_stl();
  expect_refusal(text.substr(0, text.find("endsolid")), "a.stl", "before 'endsolid'");
  expect_refusal(text.replace(text.find("endloop"), 7, "vertex "), "a.stl",
                 "line 7: 'vertex' stands where 'endloop' should");
  EXPECT_EQ(parse_polygon_soup(binary + "more", "a.stl").notes.front(),
            "ignored 4 bytes after the last triangle");
}

TEST(ReadStl, WeldsCornersThatDifferByRounding) {
  // A sphere whose corners are moved anew in every triangle by a few of the last digits.
  const TriMesh sphere = testing_support::icosahedron();
  for (const double rounding : {1e-15, 1e-7}) {
    std::string text = "solid r\n";
    int step = 0;
    for (const auto f : sphere.faces()) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const auto v : sphere.fv_range(f)) {
        const Eigen::Vector3d p = sphere.point(v) * (1.0 + rounding * (++step % 5 - 2));
        std::array<char, 100> line{};
        std::snprintf(line.data(), line.size(), "vertex %.17g %.17g %.17g\n", p.x(), p.y(), p.z());
        text += line.data();
      }
      text += "endloop\nendfacet\n";
    }
    const PolygonSoup soup = parse_polygon_soup(text + "endsolid r\n", "a.stl");
    EXPECT_EQ(soup.points.size(), 12u);
    EXPECT_NE(soup.notes.front().find("apart by rounding, up to"), std::string::npos);
    const TriangleSoup triangles = triangulate(soup);
    EXPECT_NEAR(testing_support::signed_volume(make_mesh(triangles.points, triangles.triangles)),
                testing_support::signed_volume(sphere), 1e-5);
  }
}

TEST(ReadStl, WeldsNothingThatIsClosed) {
  // Two corners of a sound surface may be as close as they like.
  std::string text = text_stl();
  for (std::size_t at = 0; (at = text.find("vertex 0 0 1\n", at)) != std::string::npos; ++at) {
    text.replace(at, 12, "vertex 1e-9 0 0");
  }
  EXPECT_EQ(parse_polygon_soup(text, "a.stl").points.size(), 4u);
}

TEST(ReadStl, KeepsTheTrianglesOfAShapeFarFromTheOrigin) {
  // 32-bit numbers near 1e6 are 1/16 apart; edges of 1 must not be welded away.
  std::string text = "solid a\n";
  for (const auto& face : {std::array{0, 1, 2}, std::array{1, 3, 2}}) {
    text += "facet normal 0 0 1 outer loop ";
    for (const int v : face) text += concat("vertex ", 1000000 + v % 2, ' ', v / 2, " 0 ");
    text += "endloop endfacet\n";
  }
  const PolygonSoup soup = parse_polygon_soup(text + "endsolid\n", "a.stl");
  EXPECT_EQ(soup.points.size(), 4u);
}

TEST(ReadStl, AcceptsKeywordsWithABlank) {
  std::string text = text_stl();
  text.replace(text.find("endsolid"), 8, "end solid");
  expect_tetrahedron(parse_polygon_soup(text, "a.stl"), welded);
  expect_refusal(text.substr(0, text.rfind("solid")), "a.stl", "'end' stands where 'facet'");
}

TEST(ReadStl, AcceptsNormalsThatAreNoNumbers) {
  std::string text = text_stl();
  text.replace(text.find("nan nan nan"), 11, "-1.#IND 1.#QNAN 1.#INF");
  expect_tetrahedron(parse_polygon_soup(text, "a.stl"), welded);
}

TEST(ReadStl, CountsTheTrianglesOfAStreamedFile) {
  std::string bytes = binary_stl("made as it went");
  bytes.replace(80, 4, std::string(4, '\0'));
  expect_tetrahedron(parse_polygon_soup(bytes, "a.stl"),
                     {"took 4 triangles, although the file declares none", welded.front()});
}

}  // namespace
}  // namespace trivalent::remesh
