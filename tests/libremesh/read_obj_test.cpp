#include <gtest/gtest.h>

#include <string>

#include "mesh_file_texts.h"

namespace trivalent::remesh {
namespace {

TEST(ReadObj, AcceptsLegalOddities) {
  expect_tetrahedron(parse_polygon_soup(obj_text, "a.obj"));
  expect_tetrahedron(
      parse_polygon_soup(obj_points + "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n", "a.obj"));
  expect_tetrahedron(
      parse_polygon_soup("# c\nmtllib m\no a\n" + obj_points +
                             "vt 0 0\nvn 0 0 1\ng g\nusemtl m\ns off\nf 1/1 3/1 2/1\nf 1/1/1 2/1/1 "
                             "4/1/1\nf 2//1 3//1 4//1 # end\nf 1 4 3",
                         "a.obj"));
  expect_tetrahedron(parse_polygon_soup(
      obj_points + "f 1 \\\n3 2\nf\\\r\n 1 2 4\nf 2 3 4\nf 1 4\\\n 3\n", "a.obj"));
  expect_tetrahedron(parse_polygon_soup(
      "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 0 0 1\n",
      "a.obj"));
}

TEST(ReadObj, IgnoresOtherElementsAndSaysSo) {
  expect_tetrahedron(parse_polygon_soup(obj_text + "l 1 2\nl 2 3\np 1\n", "a.obj"),
                     {"ignored 2 statements 'l'", "ignored 1 statement 'p'"});
}

TEST(ReadObj, BoundsItsNotes) {
  std::string text = obj_text;
  for (int k = 0; k < 100; ++k) text += concat("word", k, "\x1b[2J\n");
  const Notes notes = parse_polygon_soup(text, "a.obj").notes;
  EXPECT_EQ(notes.size(), 11u);
  EXPECT_EQ(notes.back(), "ignored 90 statements of other kinds");
  // No escape sequence reaches the terminal.
  EXPECT_EQ(notes.front(), "ignored 1 statement 'word0?[2J'");
}

TEST(ReadObj, NamesTheLineOrElementOfAnError) {
  expect_refusal(obj_points + "f 0 1 2\n", "a.obj", "line 5: '0' is no corner");
  expect_refusal(obj_points + "f 1 2 x\n", "a.obj", "line 5: 'x' is no corner");
  expect_refusal(obj_points + "f 1 2 -5\n", "a.obj", "line 5: a face refers to vertex -5");
  expect_refusal(obj_points + "f 1 2 3\nf 1 2 5\n", "a.obj", "face 2 refers to vertex 5 of 4");
  expect_refusal("v 0 0 0\nv 0 inf 0\n", "a.obj", "line 2: vertex 2");
  expect_refusal("v 0 0\n", "a.obj", "the file ends where a coordinate should stand");
  expect_refusal("v 0 0\nv 1 1 1\n", "a.obj", "line 2: 'v' stands where a coordinate should");
}

TEST(ReadPoints, TakesThreeCoordinatesPerLine) {
  const PolygonSoup soup =
      parse_polygon_soup("# x y z nx ny nz\n1 2 3 0 0 1\n\n-4 5e0 6\r\n7 8 9 0 0 1", "a.xyz");
  EXPECT_EQ(soup.points, (std::vector<Eigen::Vector3d>{{1, 2, 3}, {-4, 5, 6}, {7, 8, 9}}));
  EXPECT_TRUE(soup.ends.empty());
  EXPECT_EQ(soup.notes, Notes{"ignored further columns on 2 lines"});
}

TEST(ReadPoints, HoldsTheCountAgainstThePoints) {
  EXPECT_EQ(parse_polygon_soup("2\n1 2 3\n4 5 6\n", "a.xyz").points.size(), 2u);
  expect_refusal("3\n1 2 3\n4 5 6\n", "a.xyz", "declares 3 points but holds 2");
  expect_refusal("2000000000\n1 2 3\n", "a.xyz", "declares 2000000000 points but holds 1");
  expect_refusal("-2\n1 2 3\n", "a.xyz", "a count is negative");
}

TEST(ReadPoints, NamesTheLineOfAnError) {
  expect_refusal("1 2 3\nC 4 5 6\n", "a.xyz", "line 2: 'C' stands where a coordinate");
  expect_refusal("1 2 3\n4 inf 6\n", "a.xyz", "line 2: vertex 1 (counted from 0)");
  expect_refusal("1 2 3\n4 5\n", "a.xyz", "the file ends where a coordinate");
}

TEST(ReadObj, CountsVerticesAsTheFormatDoes) {
  expect_refusal("v 0 0 0\nv 1 nan 0\n", "a.obj", "vertex 2 (counted from 1)");
}

TEST(ReadObj, ReadsWhatMicrosoftsLibraryWritesForNoNumber) {
  // Not a comment, although it has a #.
  expect_refusal("v 0 0 0\nv 1 -1.#IND 0\n", "a.obj", "not a finite number");
  std::string text = obj_text;
  text.insert(0, "vn -1.#IND 1.#QNAN 1.#INF\nvt 1.# a comment\n");
  expect_tetrahedron(parse_polygon_soup(text, "a.obj"));
}

}  // namespace
}  // namespace trivalent::remesh
