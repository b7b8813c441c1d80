#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "temporary_folder.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {
namespace {

using testing_support::message_of;

std::string array(const std::string& name, const std::string& values) {
  return "<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"ascii\">" + values +
         "</DataArray>";
}

/// A piece with a square of two triangles, as text.
std::string piece(const std::string& cells = "NumberOfPolys=\"2\"") {
  const std::string kind = cells.find("Strips") == cells.npos ? "Polys" : "Strips";
  const bool is_strip = kind == "Strips";
  return "<Piece NumberOfPoints=\"4\" " + cells + "><Points>" +
         array("Points", "0 0 0 1 0 0 0 1 0 1 1 0") + "</Points><" + kind + ">" +
         array("connectivity", is_strip ? "0 1 2 3" : "0 1 2 1 3 2") +
         array("offsets", is_strip ? "4" : "3 6") + "</" + kind + "></Piece>";
}

std::string file(const std::string& pieces, const std::string& attributes = "type=\"PolyData\"",
                 const std::string& appended = "") {
  return "<?xml version=\"1.0\"?>\n<VTKFile " + attributes + "><PolyData>" + pieces +
         "</PolyData>" + appended + "</VTKFile>\n";
}

PolygonSoup parse(const std::string& bytes) { return parse_polygon_soup(bytes, "a.vtp"); }

void expect_refusal(const std::string& bytes, const std::string& reason) {
  const std::string message = message_of<FileError>([&] { (void)parse(bytes); });
  EXPECT_NE(message.find(reason), std::string::npos) << message << "\nof: " << bytes;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

const std::vector<int> square = {0, 1, 2, 1, 3, 2};

TEST(ReadVtp, ReadsText) {
  const PolygonSoup soup = parse(file(piece()));
  EXPECT_EQ(soup.points.size(), 4u);
  EXPECT_EQ(soup.points[3], Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(soup.corners, square);
  EXPECT_EQ(soup.ends, (std::vector<std::size_t>{3, 6}));
  EXPECT_TRUE(soup.notes.empty());
}

TEST(ReadVtp, KnowsItsFilesByTheirContent) {
  EXPECT_EQ(parse_polygon_soup(file(piece()), "a.xml").corners, square);
}

TEST(ReadVtp, CutsStripsIntoTriangles) {
  // The second as 2 1 3, which runs the same way as 1 3 2.
  EXPECT_EQ(parse(file(piece("NumberOfStrips=\"1\""))).corners, (std::vector{0, 1, 2, 2, 1, 3}));
}

TEST(ReadVtp, JoinsPieces) {
  const PolygonSoup soup = parse(file(piece() + piece()));
  EXPECT_EQ(soup.points.size(), 8u);
  EXPECT_EQ(soup.ends.size(), 4u);
  EXPECT_EQ(soup.corners[6], 4);
}

TEST(ReadVtp, SaysWhatItLeavesOut) {
  const PolygonSoup soup = parse(file(piece("NumberOfPolys=\"2\" NumberOfLines=\"3\"")));
  EXPECT_EQ(soup.notes, std::vector<std::string>{"left out 3 lines"});
}

TEST(ReadVtp, ReadsPlainBytesBehindTheXml) {
  // A point in bytes that no XML may hold.
  const std::string bytes{'\x0c', 0, 0, 0, 0, 0, '\x80', '\x3f', 0, 0, 0, '\x40', '<', '&', 0, 0};
  const std::string points =
      "<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float32\" format=\"appended\" "
      "offset=\"0\"/></Points></Piece>";
  const std::string appended = "<AppendedData encoding=\"raw\">\n _" + bytes + "</AppendedData>";
  const PolygonSoup soup = parse(file(points, "type=\"PolyData\"", appended));
  ASSERT_EQ(soup.points.size(), 1u);
  EXPECT_EQ(soup.points[0].head<2>(), Eigen::Vector2d(1, 2));
  expect_refusal(
      file(replaced(points, "offset=\"0\"", "offset=\"99\""), "type=\"PolyData\"", appended),
      "its offset '99' lies outside");
}

TEST(ReadVtp, ReadsBase64) {
  // 12 bytes: 1, 2 and 0 as 32-bit numbers, after their count.
  const auto with = [](const std::string& text, const std::string& attributes = "") {
    return file(
        "<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float32\" Name=\"p\" "
        "format=\"binary\">" +
            text + "</DataArray></Points></Piece>",
        "type=\"PolyData\"" + attributes);
  };
  const std::string encoded = "DAAAAAAAgD8AAABAAAAAAA==";
  EXPECT_EQ(parse(with("\n  " + encoded + "\n")).points.at(0), Eigen::Vector3d(1, 2, 0));
  expect_refusal(with(encoded.substr(0, 10)), "array 'p' in Points of piece 0");
  expect_refusal(with(replaced(encoded, "gD8", "g*8")), "'*' is no character of base64");
  expect_refusal(with("/////w=="), "declares 4294967295 bytes, more than");
  expect_refusal(with("DQAAAAAAgD8AAABAAAAAAAA="), "13 bytes are no whole number of Float32");
  const std::string zlib = " compressor=\"vtkZLibDataCompressor\"";
  expect_refusal(with("/////w==", zlib), "declares 4294967295 packed blocks");
  expect_refusal(with("AQAAAP///38AAAAACAAAAA==eJwDAAAAAAE=", zlib), "cannot unpack from 8 to");
  expect_refusal(with("AQAAAAwAAAAAAAAACAAAAA==eJwDAAAAAAE=", zlib), "block 0 of its packed data");
  expect_refusal(with(encoded, " compressor=\"vtkLZ4DataCompressor\""), "'vtkLZ4DataCompressor'");
}

TEST(ReadVtp, NamesThePlaceOfAnError) {
  const std::string good = file(piece());
  expect_refusal(good.substr(0, good.size() / 2), "no sound XML near byte");
  expect_refusal(file(piece(), "type=\"UnstructuredGrid\""), "'UnstructuredGrid', not PolyData");
  expect_refusal("<VTKFiles/>", "no element VTKFile");
  expect_refusal(replaced(good, "1 3 2<", "1 4 2<"), "face 1 refers to vertex 4 of 4");
  expect_refusal(replaced(good, "1 3 2<", "1 -1 2<"), "face 1 refers to vertex -1 of 4");
  expect_refusal(replaced(good, "1 3 2<", "1 0.5 2<"), "face 1 refers to vertex 0.5 of 4");
  expect_refusal(replaced(good, "1 3 2<", "1 x 2<"), "value 4 is 'x', not a number");
  expect_refusal(replaced(good, "3 6<", "3 7<"), "face 1 (counted from 0) ends at 7 of 6 corners");
  expect_refusal(replaced(good, "3 6<", "3 2<"), "face 1 (counted from 0) ends at 2");
  expect_refusal(replaced(good, "3 6<", "6<"), "declares 2 Polys, but holds 1");
  expect_refusal(replaced(good, "Points=\"4\"", "Points=\"5\""),
                 "declares 5 points, but holds 12 coordinates");
  expect_refusal(replaced(good, "Points=\"4\"", "Points=\"-5\""), "NumberOfPoints is '-5'");
  expect_refusal(replaced(good, "1 1 0<", "1 inf 0<"), "vertex 3 (counted from 0)");
  expect_refusal(replaced(good, "ascii", "morse"), "its format is 'morse'");
  const std::string unknown = replaced(replaced(good, "ascii", "binary"), "Float64", "Float16");
  expect_refusal(unknown, "its type 'Float16' is not known");
}

}  // namespace
}  // namespace trivalent::remesh
