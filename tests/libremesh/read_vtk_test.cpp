#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>

#include "mesh_file_texts.h"
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
  const std::string lz4 = " compressor=\"vtkLZ4DataCompressor\"";
  expect_refusal(with("AQAAAP///38AAAAACAAAAA==eJwDAAAAAAE=", lz4), "cannot unpack from 8 to");
  expect_refusal(with("AQAAAAwAAAAAAAAACAAAAA==eJwDAAAAAAE=", lz4), "block 0 of its packed data");
  expect_refusal(with(encoded, " compressor=\"vtkLZMADataCompressor\""), "'vtkLZMADataCompressor'");
}

TEST(ReadVtp, NamesThePlaceOfAnError) {
  const std::string good = file(piece());
  expect_refusal(good.substr(0, good.size() / 2), "no sound XML near byte");
  expect_refusal(file(piece(), "type=\"StructuredGrid\""), "'StructuredGrid', not PolyData");
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

TEST(ReadVtp, UnpacksLz4) {
  // Twelve bytes as one run of literals: their count in the upper half of the token.
  std::string block = std::string(1, '\xc0');
  for (const float x : {1.0F, 2.0F, 0.0F}) block += bytes_of(x);
  std::string appended;
  for (const std::uint32_t word : {1U, 12U, 0U, static_cast<std::uint32_t>(block.size())}) {
    appended += bytes_of(word);
  }
  const std::string points =
      "<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float32\" format=\"appended\" "
      "offset=\"0\"/></Points></Piece>";
  const PolygonSoup soup =
      parse(file(points, "type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"",
                 "<AppendedData encoding=\"raw\">_" + appended + block + "</AppendedData>"));
  ASSERT_EQ(soup.points.size(), 1u);
  EXPECT_EQ(soup.points[0], Eigen::Vector3d(1, 2, 0));
}

// ---- unstructured grids ------------------------------------------------------------------------

PolygonSoup parse_grid(const std::string& bytes) { return parse_polygon_soup(bytes, "a.vtu"); }

std::string grid(const std::string& connectivity, const std::string& offsets,
                 const std::string& types) {
  const auto cells = static_cast<std::size_t>(std::ranges::count(types, ' ')) + 1;
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"9\" "
         "NumberOfCells=\"" +
         std::to_string(cells) + "\"><Points>" +
         array("Points", "0 0 0 2 0 0 2 2 0 0 2 0 1 0 0 2 1 0 1 2 0 0 1 0 1 1 0") +
         "</Points><Cells>" + array("connectivity", connectivity) + array("offsets", offsets) +
         array("types", types) + "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

double area_of(const PolygonSoup& soup) {
  const TriangleSoup triangles = triangulate(soup);
  double area = 0.0;
  for (const auto& [a, b, c] : triangles.triangles) {
    const auto at = [&](int v) { return triangles.points[static_cast<std::size_t>(v)]; };
    area += 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).z();
  }
  return area;
}

TEST(ReadVtu, ReadsEveryKindOfFace) {
  // Each covers the square of area 4 once: quad, pixel, two triangles, a strip, a polygon.
  EXPECT_EQ(area_of(parse_grid(grid("0 1 2 3", "4", "9"))), 4.0);
  EXPECT_EQ(area_of(parse_grid(grid("0 1 3 2", "4", "8"))), 4.0);
  EXPECT_EQ(area_of(parse_grid(grid("0 1 2 0 2 3", "3 6", "5 5"))), 4.0);
  EXPECT_EQ(area_of(parse_grid(grid("0 1 3 2", "4", "6"))), 4.0);
  EXPECT_EQ(area_of(parse_grid(grid("0 4 1 5 2 3", "6", "7"))), 4.0);
  // Curved ones, with points in the middle of the edges and of the face.
  EXPECT_EQ(area_of(parse_grid(grid("0 1 2 3 4 5 6 7", "8", "23"))), 4.0);
  EXPECT_EQ(area_of(parse_grid(grid("0 1 2 3 4 5 6 7 8", "9", "28"))), 4.0);
  EXPECT_EQ(area_of(parse_grid(grid("0 1 2 4 5 8 0 2 3 8 6 7", "6 12", "22 22"))), 4.0);
  EXPECT_EQ(parse_grid(grid("0 1 2 3 4 5 6 7", "8", "23")).notes,
            Notes{"took 1 curved face as flat between their points"});
}

TEST(ReadVtu, SaysWhatItLeavesOutAndRefusesVolumes) {
  EXPECT_EQ(parse_grid(grid("0 1 2 3 0 1", "4 6", "9 3")).notes, Notes{"left out 1 line"});
  expect_refusal(grid("0 1 2 8", "4", "10"), "holds 1 cell of volumes");
  expect_refusal(grid("0 1 2 8", "4", "77"), "a cell is of VTK's type 77");
  expect_refusal(grid("0 1 2", "3", "9"), "a cell of VTK's type 9 has 3 points, not 4");
  expect_refusal(replaced(grid("0 1 2 3", "4", "9"), "types", "tips"), "has no array 'types'");
  expect_refusal(replaced(grid("0 1 2 3", "4", "9"), "OfCells=\"1\"", "OfCells=\"2\""),
                 "declares 2 cells, but holds 1");
}

// ---- legacy files ------------------------------------------------------------------------------

const std::string legacy_head = "# vtk DataFile Version 3.0\na title # 1\nASCII\n";
const std::string legacy_points = "POINTS 4 float\n" + off_points;

TEST(ReadVtk, ReadsPolygonsAndStrips) {
  const std::string data = legacy_head + "DATASET POLYDATA\n" + legacy_points;
  expect_tetrahedron(parse_polygon_soup(data + "POLYGONS 4 16\n" + off_faces, "a.vtk"));
  expect_tetrahedron(parse_polygon_soup(data + "TRIANGLE_STRIPS 1 7\n6 0 2 1 3 0 2\n", "a.vtk"));
  expect_tetrahedron(
      parse_polygon_soup(data + "VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 4 16\n" + off_faces +
                             "POINT_DATA 4\nSCALARS s float\n...",
                         "a.vtk"),
      {"left out 1 line"});
}

TEST(ReadVtk, ReadsUnstructuredGrids) {
  const std::string data = legacy_head + "DATASET UNSTRUCTURED_GRID\n" + legacy_points;
  expect_tetrahedron(
      parse_polygon_soup(data + "CELLS 5 19\n" + off_faces + "2 0 1\nCELL_TYPES 5\n5 5 5 5 3\n",
                         "grid"),
      {"left out 1 line"});
  remesh::expect_refusal(data + "CELLS 4 16\n" + off_faces, "a.vtk", "CELLS have no CELL_TYPES");
  remesh::expect_refusal(data + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n", "a.vtk", "of volumes");
}

TEST(ReadVtk, ReadsFilesOfVersion5) {
  const std::string text =
      "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET POLYDATA\nFIELD FieldData "
      "1\nTimeValue 1 "
      "1 double\n0.5\nMETADATA\nINFORMATION 0\n\nPOINTS 4 float\n" +
      off_points +
      "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1 \n\n"
      "POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 6 9 12\nCONNECTIVITY vtktypeint64\n"
      "0 2 1 0 1 3 1 2 3 0 3 2\n";
  expect_tetrahedron(parse_polygon_soup(text, "a.vtk"));
}

TEST(ReadVtk, ReadsBinaryNumbers) {
  std::string bytes = "# vtk DataFile Version 2.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 4 double\n";
  for (const auto& point : tetrahedron_points) {
    for (const float x : point) bytes += bytes_of(static_cast<double>(x), std::endian::big);
  }
  bytes += "\nPOLYGONS 4 16\n";
  const std::size_t list = bytes.size();
  for (const auto& face : tetrahedron_faces) {
    bytes += bytes_of(3, std::endian::big);
    for (const int v : face) bytes += bytes_of(v, std::endian::big);
  }
  expect_tetrahedron(parse_polygon_soup(bytes + "\n", "a.vtk"));
  remesh::expect_refusal(bytes.substr(0, bytes.size() - 1), "a.vtk",
                         "declares 64 bytes, more than the 63");
  std::string far_index = bytes;
  far_index.replace(list + 4, 4, bytes_of(9, std::endian::big));
  remesh::expect_refusal(far_index, "a.vtk", "face 0 refers to vertex 9 of 4");
  std::string long_cell = bytes;
  long_cell.replace(list, 4, bytes_of(99, std::endian::big));
  remesh::expect_refusal(long_cell, "a.vtk",
                         "cell 0 (counted from 0) does not fit into the 16 numbers");
}

TEST(ReadVtk, NamesThePlaceOfAnError) {
  const std::string data = legacy_head + "DATASET POLYDATA\n";
  remesh::expect_refusal(legacy_head + "DATASET STRUCTURED_GRID\n", "a.vtk",
                         "line 4: it holds 'STRUCTURED");
  remesh::expect_refusal("# vtk DataFile Version 3.0\nt\nMORSE\n", "a.vtk",
                         "where ASCII or BINARY should");
  remesh::expect_refusal(data + "POINTS 2000000000 float\n0 0 0\n", "a.vtk",
                         "declares 2000000000 points");
  remesh::expect_refusal(data + "POINTS 1 half\n0 0 0\n", "a.vtk",
                         "'half' is no type of VTK numbers");
  remesh::expect_refusal(data + "POINTS 1 float\n0 0 inf\n", "a.vtk", "vertex 0 (counted from 0)");
  remesh::expect_refusal(data + legacy_points + "POLYGONS 1 -4\n", "a.vtk", "a count is negative");
  remesh::expect_refusal(data + "HELLO\n", "a.vtk", "'hello' is no part of a VTK file");
}

}  // namespace
}  // namespace trivalent::remesh
