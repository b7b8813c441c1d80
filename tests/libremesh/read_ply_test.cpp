#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "mesh_file_texts.h"

namespace trivalent::remesh {
namespace {

std::string ply_header(std::string_view format, std::string_view real = "float") {
  return concat("ply\nformat ", format,
                " 1.0\ncomment made by C:\\hand\\\nelement vertex 4\nproperty ", real,
                " x\nproperty uchar red\nproperty ", real, " y\nproperty ", real,
                " z\nelement face 4\nproperty list uchar int vertex_indices\nproperty short mark\n"
                "element extra 1\nproperty list ushort double values\nend_header\n");
}

std::string binary_ply(std::endian order) {
  std::string bytes =
      ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const auto& [x, y, z] : tetrahedron_points) {
    bytes += bytes_of(x, order) + '\xff' + bytes_of(y, order) + bytes_of(z, order);
  }
  for (const auto& face : tetrahedron_faces) {
    bytes += '\3';
    for (const int v : face) bytes += bytes_of(v, order);
    bytes += bytes_of(std::int16_t{-7}, order);
  }
  return bytes + bytes_of(std::uint16_t{2}, order) + bytes_of(1.5, order) + bytes_of(-1.5, order);
}

TEST(ReadPly, ReadsEveryEncoding) {
  const Notes notes = {"ignored 1 element 'extra'"};
  expect_tetrahedron(parse_polygon_soup(binary_ply(std::endian::little), "a.ply"), notes);
  expect_tetrahedron(parse_polygon_soup(binary_ply(std::endian::big), "a.ply"), notes);
  const std::string text =
      ply_header("ascii", "float64") +
      "0 9 0 0\n1 9 0 0\n0 9 1 0\n0 9 0 1\n3 0 2 1 5\n3 0 1 3 5\n3 1 2 3 5\n3 0 3 2 5\n2 1 2\n";
  expect_tetrahedron(parse_polygon_soup(text, "a.ply"), notes);
}

TEST(ReadPly, ReadsPointsWithoutFaces) {
  const PolygonSoup soup = parse_polygon_soup(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n1 2 3\n",
      "a.ply");
  EXPECT_EQ(soup.points.size(), 1u);
  EXPECT_TRUE(soup.ends.empty());
}

TEST(ReadPly, NamesThePlaceOfAnError) {
  std::string bytes = binary_ply(std::endian::little);
  const std::size_t body = ply_header("binary_little_endian").size();
  expect_refusal(bytes.substr(0, bytes.size() - 1), "a.ply", "within an element");
  expect_refusal(bytes.substr(0, bytes.size() - 16), "a.ply", "a list of 2 values");
  std::string not_finite = bytes;
  not_finite.replace(body + 13, 4, bytes_of(std::nanf("")));
  expect_refusal(not_finite, "a.ply", "vertex 1 (counted from 0)");
  std::string far_index = bytes;
  far_index.replace(body + 4 * 13 + 1, 4, bytes_of(77));
  expect_refusal(far_index, "a.ply", "face 0 refers to vertex 77 of 4");
  std::string negative_index = bytes;
  negative_index.replace(body + 4 * 13 + 1, 4, bytes_of(-1));
  expect_refusal(negative_index, "a.ply", concat("byte ", body + 4 * 13 + 5, ": face 0"));
  expect_refusal(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 "
      "2\n",
      "a.ply", "no property 'z'");
  expect_refusal("ply\nformat morse 1.0\n", "a.ply", "line 2: 'morse' is no PLY encoding");
  expect_refusal("ply\nelement vertex 0\nend_header\n", "a.ply", "does not tell its format");
  expect_refusal("ply\nformat ascii 1.0\nproperty float x\n", "a.ply", "before the first element");
  expect_refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "a.ply",
                 "'real' is no type");
  expect_refusal("ply\nformat ascii 1.0\nhello\n", "a.ply", "'hello' is no part");
}

TEST(ReadPly, RefusesDeclarationsThatTheFileCannotHold) {
  const auto header = [](std::string_view format, std::string_view vertices) {
    return concat("ply\nformat ", format, " 1.0\nelement vertex ", vertices,
                  "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n");
  };
  expect_refusal(header("ascii", "2000000000"), "a.ply", "declares 2000000000 'vertex' elements");
  expect_refusal(header("binary_little_endian", "2000000000"), "a.ply",
                 "declares 2000000000 'vertex'");
  expect_refusal(header("ascii", "-1"), "a.ply", "a count is negative");
  // Elements of no bytes would be counted for ever.
  expect_refusal("ply\nformat ascii 1.0\nelement void 9000000000000000000\nend_header\n", "a.ply",
                 "have no properties");
  const std::string list =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int "
      "vertex_indices\nend_header\n";
  expect_refusal(list + "\xff\xff\xff\x7f", "a.ply", "a list of 2.14748e+09 values");
}

/// The tetrahedron as little-endian 32-bit numbers, its header lines ending as said.
std::string ply_with_line_ends(const std::string& line_end, const std::string& last_line_end,
                               float first_x = 0.0F) {
  std::string bytes;
  for (const std::string line : {"ply", "format binary_little_endian 1.0", "element vertex 4",
                                 "property float x", "property float y", "property float z",
                                 "element face 4", "property list uchar int vertex_indices"}) {
    bytes += line + line_end;
  }
  bytes += "end_header" + last_line_end;
  for (std::size_t v = 0; v < tetrahedron_points.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      bytes += bytes_of(v == 0 && k == 0 ? first_x : tetrahedron_points[v][k]);
    }
  }
  for (const auto& face : tetrahedron_faces) {
    bytes += '\3';
    for (const int v : face) bytes += bytes_of(v);
  }
  return bytes;
}

TEST(ReadPly, FindsTheDataBehindAnyLineEnd) {
  const std::vector<std::string> ends = {"\n", "\r\n", "\r", "\n\r", " \n", "\t\r\n"};
  for (const std::string& all : ends) {
    for (const std::string& last : ends) {
      expect_tetrahedron(parse_polygon_soup(ply_with_line_ends(all, last), "a.ply"));
    }
  }
}

TEST(ReadPly, IsNotMisledByDataThatLookLikeALineEnd) {
  // The lowest byte of the first coordinate, which is next to 0, is LF or CR.
  for (const std::string byte : {"\n", "\r"}) {
    const auto first_x = std::bit_cast<float>(static_cast<std::uint32_t>(byte[0]));
    for (const std::string line_end : {"\n", "\r\n", "\r", "\n\r"}) {
      expect_tetrahedron(
          parse_polygon_soup(ply_with_line_ends(line_end, line_end, first_x), "a.ply"));
    }
  }
}

TEST(ReadPly, SaysWhatFollowsTheLastElement) {
  EXPECT_EQ(parse_polygon_soup(ply_with_line_ends("\n", "\n") + "more", "a.ply").notes,
            Notes{"ignored 4 bytes after the last element"});
}

TEST(ReadPly, CutsStripsIntoTriangles) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
      off_points;
  expect_tetrahedron(parse_polygon_soup(head + "6 0 2 1 3 0 2\n", "a.ply"));
  // Two strips, the second with a triangle that repeats a corner.
  expect_tetrahedron(parse_polygon_soup(head + "11 0 2 1 3 -1 1 3 0 2 2 -1\n", "a.ply"));
  expect_refusal(head + "3 0 1 -2\n", "a.ply", "strip 0 (counted from 0) refers to vertex -2");
  expect_refusal(head + "3 0 1 4\n", "a.ply", "refers to vertex 4 of 4");
}

}  // namespace
}  // namespace trivalent::remesh
