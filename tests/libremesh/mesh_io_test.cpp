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

#include "mesh_file_texts.h"
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

}  // namespace
}  // namespace trivalent::remesh
