#include "trivalent/remesh/mesh_io.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "mesh_fixtures.h"
#include "temporary_folder.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {
namespace {

namespace fs = std::filesystem;
using testing_support::contents_of;
using testing_support::icosahedron;
using testing_support::message_of;
using testing_support::signed_volume;
using testing_support::TemporaryFolder;

using Notes = std::vector<std::string>;

/// Text of a right-angled tetrahedron, volume 1/6, after which tests may put more.
const std::string off_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string off_faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string off_text = "OFF\n4 4 0\n" + off_points + off_faces;
const std::string obj_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string obj_text = obj_points + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

void expect_tetrahedron(const PolygonSoup& soup, const Notes& notes = {}) {
  const TriangleSoup triangles = triangulate(soup);
  EXPECT_EQ(triangles.notes, notes);
  const TriMesh mesh = make_mesh(triangles.points, triangles.triangles);
  EXPECT_EQ(mesh.n_vertices(), 4u);
  EXPECT_EQ(mesh.n_faces(), 4u);
  EXPECT_NEAR(signed_volume(mesh), 1.0 / 6.0, 1e-15);
}

/// What parsing says against the bytes; empty if it accepts them.
std::string refusal(std::string_view bytes, const std::string& name) {
  return message_of<FileError>([&] { (void)parse_polygon_soup(bytes, name); });
}

void expect_refusal(std::string_view bytes, const std::string& name, std::string_view reason) {
  const std::string message = refusal(bytes, name);
  EXPECT_NE(message.find(reason), std::string::npos) << "message: " << message << "\nof: " << bytes;
  EXPECT_EQ(message.find("read_mesh: " + name), 0u) << message;
}

/// Numbers as they stand in binary files.
template <typename T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
  std::string bytes(sizeof(T), '\0');
  const auto bits = std::bit_cast<std::array<char, sizeof(T)>>(value);
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    bytes[k] = order == std::endian::native ? bits[k] : bits[sizeof(T) - 1 - k];
  }
  return bytes;
}

std::string gzipped(const TemporaryFolder& folder, const std::string& text) {
  const fs::path path = folder.path() / "packed.gz";
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return contents_of(path);
}

// ---- writing -----------------------------------------------------------------------------------

TEST(WriteMesh, TextReadsBackToTheSameBits) {
  const TemporaryFolder folder;
  TriMesh mesh = icosahedron();
  // Numbers with many digits, a subnormal one and a negative zero.
  scale(mesh, std::numbers::pi * 1e-7);
  mesh.point(VertexHandle(0)).x() = -0.0;
  mesh.point(VertexHandle(1)).x() = 4.9e-324;
  mesh.point(VertexHandle(2)).x() = -1.7976931348623157e308;
  for (const auto* name : {"a.off", "a.obj", "a.ply", "A.OFF"}) {
    write_mesh(mesh, folder.path() / name);
    const MeshFile file = read_mesh(folder.path() / name);
    EXPECT_EQ(file.notes, Notes()) << name;
    EXPECT_EQ(triangles_of(file.mesh), triangles_of(mesh)) << name;
    for (const auto v : mesh.vertices()) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(file.mesh.point(v)[k]),
                  std::bit_cast<std::uint64_t>(mesh.point(v)[k]));
      }
    }
  }
}

TEST(WriteMesh, StlReadsBackToThe32BitNumbers) {
  const TemporaryFolder folder;
  const TriMesh mesh = icosahedron();
  write_mesh(mesh, folder.path() / "a.stl");
  EXPECT_EQ(fs::file_size(folder.path() / "a.stl"), 84u + 20u * 50u);
  const MeshFile file = read_mesh(folder.path() / "a.stl");
  EXPECT_EQ(file.notes, Notes{"welded 60 corners into 12 vertices"});
  EXPECT_EQ(file.mesh.n_vertices(), 12u);
  // Half a unit in the last place of 24-bit numbers of about 1.6.
  EXPECT_NEAR(signed_volume(file.mesh), signed_volume(mesh), 1e-6 * signed_volume(mesh));
}

TEST(WriteMesh, ThrowsOnAnUnknownExtension) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_mesh(icosahedron(), folder.path() / "a.xyz"), FileError);
  EXPECT_THROW(write_mesh(icosahedron(), folder.path() / "a"), FileError);
  EXPECT_EQ(folder.count_files(), 0);
}

TEST(WriteMesh, ThrowsOnAPositionThatIsNotFinite) {
  const TemporaryFolder folder;
  TriMesh mesh = icosahedron();
  mesh.point(VertexHandle(7)).y() = std::nan("");
  const auto message = message_of<InvalidMesh>([&] { write_mesh(mesh, folder.path() / "a.off"); });
  EXPECT_NE(message.find("vertex 7"), std::string::npos) << message;
  EXPECT_EQ(folder.count_files(), 0);
}

TEST(WriteMesh, ThrowsOnAMissingFolder) {
  EXPECT_THROW(write_mesh(icosahedron(), "/nonexistent/a.off"), FileError);
}

TEST(WriteMesh, ThrowsOnCoordinatesThatStlCannotHold) {
  const TemporaryFolder folder;
  TriMesh mesh = icosahedron();
  scale(mesh, 1e39);
  EXPECT_THROW(write_mesh(mesh, folder.path() / "a.stl"), FileError);
  EXPECT_EQ(folder.count_files(), 0);
}

// ---- real files --------------------------------------------------------------------------------

TEST(ReadMesh, ReadsRealMeshesWhole) {
  struct Known {
    std::string file;
    std::size_t vertices, faces;
    Notes notes;
  };
  // Counts as declared in the files' headers.
  const std::vector<Known> meshes = {
      {"bunny00.off", 37706, 75408, {}},
      {"elephant.off", 2775, 5558, {}},
      {"fandisk.off", 6475, 12946, {}},
      {"lion-head.off", 8356, 16674, {}},
      {"knot2.off", 5760, 11520, {}},
      {"cube_quad.off", 8, 12, {"split 6 quads"}},
      {"sphere.stl", 162, 320, {"welded 960 corners into 162 vertices"}},
      {"colored_tetra.ply", 4, 4, {"ignored 6 elements 'edge'"}}};
  for (const Known& known : meshes) {
    const MeshFile file = read_mesh(fs::path(TRIVALENT_MESHES) / known.file);
    EXPECT_EQ(file.mesh.n_vertices(), known.vertices) << known.file;
    EXPECT_EQ(file.mesh.n_faces(), known.faces) << known.file;
    EXPECT_EQ(file.notes, known.notes) << known.file;
  }
}

TEST(ReadMesh, DropsIsolatedVerticesAndSaysSo) {
  const TemporaryFolder folder;
  const auto path = folder.file(
      "a.off", "OFF 5 4 0\n7 7 7\n" + off_points + "3 1 3 2\n3 1 2 4\n3 2 3 4\n3 1 4 3\n");
  const MeshFile file = read_mesh(path);
  EXPECT_EQ(file.mesh.n_vertices(), 4u);
  EXPECT_EQ(file.mesh.point(VertexHandle(1)), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(file.notes, Notes{"dropped 1 isolated vertex"});
}

TEST(ReadMesh, ThrowsOnWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)read_mesh(folder.path() / "none.off"), FileError);
  EXPECT_THROW((void)read_mesh(folder.path()), FileError);
  fs::create_directory(folder.path() / "folder.off");
  EXPECT_THROW((void)read_mesh(folder.path() / "folder.off"), FileError);
}

TEST(ReadMesh, ThrowsOnAFileThatItMayNotRead) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.off", off_text);
  fs::permissions(path, fs::perms::none);
  if (!contents_of(path).empty()) GTEST_SKIP() << "this user may read everything";
  EXPECT_THROW((void)read_mesh(path), FileError);
}

TEST(ReadMesh, ThrowsOnAFileWithoutFaces) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)read_mesh(folder.file("a.off", "OFF 0 0 0\n")), FileError);
  EXPECT_THROW((void)read_mesh(folder.file("b.off", "OFF 4 0 0\n" + off_points)), FileError);
  EXPECT_THROW((void)read_mesh(folder.file("c.obj", obj_points)), FileError);
}

TEST(ReadMesh, NamesTheElementThatIsNotManifold) {
  const TemporaryFolder folder;
  // Face 3 turned over; vertices count as in the file although vertex 0 is isolated.
  const auto path = folder.file(
      "a.off", "OFF 5 4 0\n7 7 7\n" + off_points + "3 1 3 2\n3 1 2 4\n3 2 3 4\n3 1 3 4\n");
  const auto message = message_of<InvalidMesh>([&] { (void)read_mesh(path); });
  EXPECT_NE(message.find("faces 0 and 3"), std::string::npos) << message;
  EXPECT_NE(message.find("from vertex 1 to 3"), std::string::npos) << message;
}

// ---- any kind ----------------------------------------------------------------------------------

TEST(ParsePolygonSoup, ReadsByContentWhereTheExtensionDisagrees) {
  expect_tetrahedron(parse_polygon_soup(off_text, "a.ply"),
                     {"read as OFF, which its content is, not as PLY"});
  EXPECT_EQ(parse_polygon_soup("ply\nformat ascii 1.0\nend_header\n", "a.stl").notes.size(), 1u);
}

TEST(ParsePolygonSoup, ReadsByContentWithoutAnExtension) {
  for (const auto* name : {"/dev/stdin", "a", "a.mesh", "a.gz"}) {
    expect_tetrahedron(parse_polygon_soup(off_text, name));
    expect_tetrahedron(parse_polygon_soup("# a comment\n" + obj_text, name));
    EXPECT_EQ(parse_polygon_soup("1 2 3\n4 5 6\n", name).points.size(), 2u);
  }
}

TEST(ParsePolygonSoup, ReadsGzippedFiles) {
  const TemporaryFolder folder;
  const std::string packed = gzipped(folder, off_text);
  expect_tetrahedron(parse_polygon_soup(packed, "a.off.gz"));
  expect_tetrahedron(parse_polygon_soup(packed, "a.off"));
  expect_refusal(packed.substr(0, packed.size() / 2), "a.off.gz", "damaged gzip data");
  const std::string bomb = gzipped(folder, off_text + std::string(10'000'000, '\n'));
  expect_refusal(bomb, "a.off.gz", "bytes unpack to more than 200 times as many");
  expect_refusal(gzipped(folder, packed), "a.off.gz", "gzipped twice");
  // A flat part packs well, but not all of the file.
  const std::string blanks = gzipped(folder, off_text + std::string(1'000'000, '\n'));
  expect_tetrahedron(parse_polygon_soup(blanks, "a.off.gz"));
}

TEST(ParsePolygonSoup, SkipsTheMarkThatSomeEditorsPutFirst) {
  const std::string mark = "\xef\xbb\xbf";
  expect_tetrahedron(parse_polygon_soup(mark + off_text, "a.off"));
  expect_tetrahedron(parse_polygon_soup(mark + off_text, "/dev/stdin"));
  expect_tetrahedron(parse_polygon_soup(mark + obj_text, "a.obj"));
  expect_refusal(mark, "a.off", "is empty");
}

TEST(ParsePolygonSoup, RefusesTextOf16BitsALetter) {
  for (const std::string mark : {"\xff\xfe", "\xfe\xff"}) {
    expect_refusal(mark + off_text, "a.off", "save it as UTF-8");
  }
}

TEST(ParsePolygonSoup, RefusesUnknownExtensionsAndEmptyFiles) {
  expect_refusal("ISO-10303-21;\n", "a.step", "neither its extension '.step' nor its content");
  for (const auto* name : {"a.off", "a.obj", "a.ply", "a.stl"})
    expect_refusal("", name, "is empty");
}

// A prefix of a sound file may look sound only if it lacks nothing but the last line's end.
TEST(ParsePolygonSoup, RefusesEveryFileCutShort) {
  const TemporaryFolder folder;
  for (const auto* name : {"a.off", "a.ply", "a.stl"}) {
    write_mesh(icosahedron(), folder.path() / name);
    const std::string whole = contents_of(folder.path() / name);
    for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
      EXPECT_NE(refusal(whole.substr(0, size), name), "") << name << " cut to " << size;
    }
  }
}

// ---- OFF ---------------------------------------------------------------------------------------

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
  expect_refusal("OFF BINARY\n", "a.off", "binary OFF");
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

// ---- OBJ ---------------------------------------------------------------------------------------

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
  expect_refusal("v 0 0 0\nv 0 inf 0\n", "a.obj", "line 2: vertex 1");
  expect_refusal("v 0 0\n", "a.obj", "the file ends where a coordinate should stand");
  expect_refusal("v 0 0\nv 1 1 1\n", "a.obj", "line 2: 'v' stands where a coordinate should");
}

// ---- PLY ---------------------------------------------------------------------------------------

std::string ply_header(std::string_view format, std::string_view real = "float") {
  return concat("ply\nformat ", format,
                " 1.0\ncomment made by C:\\hand\\\nelement vertex 4\nproperty ", real,
                " x\nproperty uchar red\nproperty ", real, " y\nproperty ", real,
                " z\nelement face 4\nproperty list uchar int vertex_indices\nproperty short mark\n"
                "element extra 1\nproperty list ushort double values\nend_header\n");
}

const std::vector<std::array<float, 3>> ply_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<std::array<int, 3>> ply_faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

std::string binary_ply(std::endian order) {
  std::string bytes =
      ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const auto& [x, y, z] : ply_points) {
    bytes += bytes_of(x, order) + '\xff' + bytes_of(y, order) + bytes_of(z, order);
  }
  for (const auto& face : ply_faces) {
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

// ---- STL ---------------------------------------------------------------------------------------

std::string text_stl() {
  std::string text = "solid a name # 7\n";
  for (const auto& face : ply_faces) {
    text += "  facet normal nan nan nan\n    outer loop\n";
    for (const int v : face) {
      const auto& [x, y, z] = ply_points[static_cast<std::size_t>(v)];
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
  for (const auto& face : ply_faces) {
    bytes += std::string(12, '\0');
    for (const int v : face) {
      for (const float x : ply_points[static_cast<std::size_t>(v)]) bytes += bytes_of(x);
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

// ---- points ------------------------------------------------------------------------------------

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

// ---- triangulation -----------------------------------------------------------------------------

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

}  // namespace
}  // namespace trivalent::remesh
