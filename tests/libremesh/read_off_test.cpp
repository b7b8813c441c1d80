#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "mesh_file_texts.h"

namespace trivalent::remesh {
namespace {

TEST(ReadOff, AcceptsLegalOddities) {
  expect_tetrahedron(parse_polygon_soup(off_text, "a.off"));
  expect_tetrahedron(parse_polygon_soup(
      "OFF # a comment\n# another\n\n4 4 6\n" + off_points + "# and one\n" + off_faces, "a.off"));
  expect_tetrahedron(parse_polygon_soup("OFF 4 4 0\n" + off_points + off_faces, "a.off"));
  expect_tetrahedron(parse_polygon_soup("OFF\n4 4\n" + off_points + off_faces, "a.off"));
  expect_tetrahedron(parse_polygon_soup("4 4 0\n" + off_points + off_faces, "a.off"));
  expect_tetrahedron(
      parse_polygon_soup("OFF\n4 4 0\n0 0\n0 1 0 0\n0 1 0 0 0 1\n" + off_faces, "a.off"));
  expect_tetrahedron(parse_polygon_soup(
      "OFF\n4 4 0\n+0 0e5 -0.0\n1. .0 0\n0 1e0 0\n0 1e-400 1\n" + off_faces, "a.off"));
  std::string crlf, cr;
  for (const char c : off_text) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  expect_tetrahedron(parse_polygon_soup(crlf, "a.off"));
  expect_tetrahedron(parse_polygon_soup(cr, "a.off"));
}

TEST(ReadOff, IgnoresFurtherColumnsAndSaysSo) {
  const std::string colored =
      "COFF\n4 4 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 0 0 0 1\n0 0 1 0 0 0 1\n";
  expect_tetrahedron(parse_polygon_soup(colored + off_faces, "a.off"),
                     {"ignored further columns on 4 lines"});
  expect_tetrahedron(parse_polygon_soup(off_text + "3 0 1 2\n", "a.off"),
                     {"ignored 1 line after the last face"});
}

TEST(ReadOff, NamesTheLineOfAnError) {
  expect_refusal("OFF\n4 4 0\n0 0 0\n1 0 nan\n0 1 0\n0 0 1\n" + off_faces, "a.off",
                 "line 4: vertex 1");
  expect_refusal("OFF\n4 4 0\n0 0 0\n1 0 1e999\n0 1 0\n0 0 1\n" + off_faces, "a.off",
                 "not a finite number");
  expect_refusal("OFF\n4 4 0\n0 0 0\n1 0 zero\n0 1 0\n0 0 1\n" + off_faces, "a.off",
                 "line 4: 'zero' stands where a coordinate");
  expect_refusal("OFF\n4 4 0\n" + off_points + "3 0 1 2\n3 0 1 4\n3 0 1 2\n3 0 1 2\n", "a.off",
                 "line 8: face 1 refers to vertex 4 of 4");
  expect_refusal("OFF\n4 4 0\n" + off_points + "3 0 1 -1\n3 0 1 2\n3 0 1 2\n3 0 1 2\n", "a.off",
                 "refers to vertex -1");
  expect_refusal("OFF\n4 4 0\n" + off_points + "0\n3 0 1 2\n3 0 1 2\n3 0 1 2\n", "a.off",
                 "face 0 has 0 corners");
  expect_refusal("4OFF\n1 0 0\n0 0 0 0\n", "a.off", "not three-dimensional");
  expect_refusal("OFF BINARY\n", "a.off", "ends within a number");
  expect_refusal("hello\n", "a.off", "its first word is not OFF");
}

TEST(ReadOff, RefusesDeclarationsThatTheFileCannotHold) {
  expect_refusal("OFF\n", "a.off", "the file ends where the number of vertices");
  expect_refusal("OFF\n2000000000 4 0\n" + off_points + off_faces, "a.off",
                 "declares 2000000000 vertices");
  expect_refusal("OFF\n4 2000000000 0\n" + off_points + off_faces, "a.off",
                 "declares 2000000000 faces");
  expect_refusal("OFF\n9999999999999999999 4 0\n", "a.off", "stands where the number of vertices");
  expect_refusal("OFF\n-4 4 0\n" + off_points, "a.off", "a count is negative");
  expect_refusal("OFF\n4 4 0\n" + off_points + "2000000000 0 1 2\n3 0 1 2\n3 0 1 2\n3 0 1 2\n",
                 "a.off", "declares 2000000000 corners");
}

TEST(ReadOff, AcceptsCountsWithoutABlankBeforeThem) {
  // As in ModelNet's files.
  expect_tetrahedron(parse_polygon_soup("OFF4 4 0\n" + off_points + off_faces, "a.off"));
  expect_tetrahedron(parse_polygon_soup("OFF4 4 6\n" + off_points + off_faces, "a"));
  expect_refusal("OFFS4 4 0\n" + off_points + off_faces, "a.off", "its first word is not OFF");
}

TEST(ReadOff, AcceptsAFileOnOneLine) {
  for (const std::string head : {"OFF 4 4 0 ", "OFF4 4 6 ", "4 4 0 "}) {
    std::string text = head + off_points + off_faces;
    for (char& c : text) c = c == '\n' ? ' ' : c;
    expect_tetrahedron(parse_polygon_soup(text, "a.off"));
  }
}

/// What a binary file may hold beside positions and corners.
struct BinaryOff {
  std::string keyword = "OFF BINARY\n";
  std::endian order = std::endian::big;
  int numbers_after_position = 0;
  bool has_face_colors = true;
};

std::string binary_off(const BinaryOff& kind) {
  std::string bytes = kind.keyword;
  for (const int count : {4, 4, 6}) bytes += bytes_of(count, kind.order);
  for (const auto& point : tetrahedron_points) {
    for (const float x : point) bytes += bytes_of(x, kind.order);
    for (int k = 0; k < kind.numbers_after_position; ++k) bytes += bytes_of(0.5F, kind.order);
  }
  for (std::size_t f = 0; f < tetrahedron_faces.size(); ++f) {
    bytes += bytes_of(3, kind.order);
    for (const int v : tetrahedron_faces[f]) bytes += bytes_of(v, kind.order);
    if (!kind.has_face_colors) continue;
    const int colors = f == 0 ? 4 : 0;
    bytes += bytes_of(colors, kind.order);
    for (int k = 0; k < colors; ++k) bytes += bytes_of(1.0F, kind.order);
  }
  return bytes;
}

TEST(ReadOff, ReadsBinaryFiles) {
  expect_tetrahedron(parse_polygon_soup(binary_off({}), "a.off"));
  expect_tetrahedron(parse_polygon_soup(binary_off({.keyword = "OFF binary \r\n"}), "a.off"));
  expect_tetrahedron(parse_polygon_soup(
      binary_off({.keyword = "STCNOFF BINARY\n", .numbers_after_position = 9}), "a.off"));
  expect_tetrahedron(parse_polygon_soup(
      binary_off({.order = std::endian::little, .has_face_colors = false}), "a.off"));
  EXPECT_EQ(parse_polygon_soup(binary_off({}) + "more", "a.off").notes,
            Notes{"ignored 4 bytes after the last face"});
}

TEST(ReadOff, RefusesBinaryFilesThatAreDamaged) {
  const std::string good = binary_off({});
  for (const std::size_t size : {std::size_t{15}, std::size_t{40}, good.size() - 1}) {
    EXPECT_NE(refusal(good.substr(0, size), "a.off"), "");
  }
  std::string far_index = good;
  far_index.replace(11 + 12 + 4 * 12 + 4, 4, bytes_of(9, std::endian::big));
  expect_refusal(far_index, "a.off", "face 0 refers to vertex 9 of 4");
  std::string bomb = good;
  bomb.replace(11, 4, "\x7f\xff\xff\xff");
  expect_refusal(bomb, "a.off", "declares 2147483647 vertices");
}

}  // namespace
}  // namespace trivalent::remesh
