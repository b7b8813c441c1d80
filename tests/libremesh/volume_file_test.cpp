#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "sampled_volume.h"
#include "temporary_folder.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {
namespace {

template <typename Number>
std::string bytes_of(Number number, bool is_big_endian = false) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  if (is_big_endian) std::ranges::reverse(bytes);
  return bytes;
}

template <typename Number>
std::string packed(const Volume& volume, bool is_big_endian = false) {
  std::string bytes;
  for (const float value : volume.values) {
    bytes += bytes_of(static_cast<Number>(value), is_big_endian);
  }
  return bytes;
}

std::string text_of(const Volume& volume) {
  std::ostringstream text;
  for (const float value : volume.values) text << value << ' ';
  return text.str();
}

std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  constexpr int window_and_gzip_header = 15 + 16;
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, window_and_gzip_header, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  std::string in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string nrrd_header(const std::string& type, const std::string& encoding,
                        const std::string& more = "") {
  return "NRRD0004\n# a comment\ntype: " + type +
         "\ndimension: 3\nspace dimension: 3\nsizes: 3 4 5\nencoding: " + encoding +
         "\nspace directions: (0.5,0,0) (0, 0.25, 0) (0,0,2)\nspace origin: (1,-2,0.5)\n" +
         "a key:=a value\n" + more + "\n";
}

std::string cube_of(const Volume& volume, double unit, int sign) {
  std::ostringstream text;
  text.precision(12);
  text << "made by a test\nof two comments\n 1 " << (volume.origin / unit).transpose() << '\n';
  for (Eigen::Index k = 0; k < 3; ++k) {
    text << sign * volume.size[static_cast<std::size_t>(k)] << ' '
         << (volume.steps.col(k) / unit).transpose() << '\n';
  }
  text << "6 6.0 0 0 0\n";
  for (int x = 0; x < volume.size[0]; ++x) {
    for (int y = 0; y < volume.size[1]; ++y) {
      for (int z = 0; z < volume.size[2]; ++z) {
        text << volume.values[index_of(volume.size, x, y, z)] << ' ';
      }
      text << '\n';
    }
  }
  return text.str();
}

/// A map whose columns, rows and sections run along three axes of the volume.
std::string mrc_of(const Volume& volume, const std::array<std::size_t, 3>& axes, bool big_endian) {
  std::string header(1024, '\0');
  const auto put = [&](std::size_t word, const std::string& bytes) {
    header.replace(4 * (word - 1), bytes.size(), bytes);
  };
  const auto integer = [&](std::size_t word, int value) { put(word, bytes_of(value, big_endian)); };
  const auto real = [&](std::size_t word, double value) {
    put(word, bytes_of(static_cast<float>(value), big_endian));
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    integer(1 + k, volume.size[axes[k]]);
    integer(8 + k, volume.size[k]);
    real(11 + k, volume.size[k] * volume.steps(i, i));
    real(14 + k, 90.0);
    integer(17 + k, static_cast<int>(axes[k]) + 1);
    real(50 + k, volume.origin[i]);
  }
  integer(4, 2);
  put(53, "MAP ");
  put(54, big_endian ? std::string("\x11\x11\0\0", 4) : std::string("\x44\x44\0\0", 4));
  std::array<int, 3> at = {};
  for (at[axes[2]] = 0; at[axes[2]] < volume.size[axes[2]]; ++at[axes[2]]) {
    for (at[axes[1]] = 0; at[axes[1]] < volume.size[axes[1]]; ++at[axes[1]]) {
      for (at[axes[0]] = 0; at[axes[0]] < volume.size[axes[0]]; ++at[axes[0]]) {
        header += bytes_of(volume.values[index_of(volume.size, at[0], at[1], at[2])], big_endian);
      }
    }
  }
  return header;
}

std::string vti_of(const std::string& extent, const std::string& pieces) {
  return "<?xml version=\"1.0\"?><VTKFile type=\"ImageData\" version=\"1.0\"><ImageData "
         "WholeExtent=\"" +
         extent + "\" Origin=\"0 0 0\" Spacing=\"0.5 0.25 2\">" + pieces + "</ImageData></VTKFile>";
}

std::string vti_piece(const std::string& extent, const std::string& kind,
                      const std::string& values) {
  return "<Piece Extent=\"" + extent + "\"><" + kind + " Scalars=\"density\"><DataArray type=" +
         "\"Float32\" Name=\"gradient\" NumberOfComponents=\"3\" format=\"ascii\">1 2 3</DataArray>"
         "<DataArray type=\"Float32\" Name=\"density\" format=\"ascii\">" +
         values + "</DataArray></" + kind + "></Piece>";
}

class VolumeFile : public testing::Test {
 protected:
  [[nodiscard]] Volume read(const std::string& name, const std::string& bytes,
                            const std::optional<RawLayout>& raw = {}) {
    return read_volume(write(name, bytes), raw);
  }
  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::filesystem::path path = folder_.path() / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  void expect_refusal(const std::string& words, const std::string& name, const std::string& bytes) {
    try {
      static_cast<void>(read(name, bytes));
      FAIL() << name << " was read";
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  testing_support::TemporaryFolder folder_;
};

void expect_same(const Volume& found, const Volume& wanted, double tolerance = 0.0) {
  EXPECT_EQ(found.size, wanted.size);
  EXPECT_TRUE(found.origin.isApprox(wanted.origin, 1e-6)) << found.origin.transpose();
  EXPECT_TRUE(found.steps.isApprox(wanted.steps, 1e-6)) << found.steps;
  ASSERT_EQ(found.values.size(), wanted.values.size());
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    EXPECT_NEAR(found.values[i], wanted.values[i], tolerance) << i;
  }
}

TEST_F(VolumeFile, IsTheSameInEveryFormat) {
  const Volume wanted = lopsided();
  constexpr double bohr = 0.529177210903;
  expect_same(read("a.cube", cube_of(wanted, bohr, 1)), wanted, 1e-5);
  expect_same(read("b.cub", cube_of(wanted, 1.0, -1)), wanted, 1e-5);
  expect_same(read("c.cube.gz", gzipped(cube_of(wanted, bohr, 1))), wanted, 1e-5);
  const std::string little = packed<float>(wanted);
  expect_same(read("a.nrrd", nrrd_header("float", "raw", "endian: little\n") + little), wanted);
  expect_same(
      read("b.nrrd", nrrd_header("double", "raw", "endian: big\n") + packed<double>(wanted, true)),
      wanted);
  expect_same(read("c.nrrd", nrrd_header("float", "gzip", "endian: little\n") + gzipped(little)),
              wanted);
  expect_same(read("skipped.nrrd", nrrd_header("float", "gzip", "endian: little\nbyte skip: 7\n") +
                                       gzipped("skipped" + little)),
              wanted);
  expect_same(read("d.nrrd", nrrd_header("double", "ascii") + text_of(wanted)), wanted, 1e-5);
  write("values.bin", "skipped" + little);
  expect_same(read("e.nhdr", nrrd_header("float", "raw",
                                         "endian: little\nbyte skip: 7\ndata file: values.bin\n")),
              wanted);
  expect_same(read("f.nhdr", nrrd_header("float", "raw",
                                         "endian: little\nbyte skip: -1\ndata file: values.bin\n")),
              wanted);
  expect_same(read("a.mrc", mrc_of(wanted, {0, 1, 2}, false)), wanted);
  expect_same(read("b.map", mrc_of(wanted, {2, 0, 1}, true)), wanted);
  expect_same(read("c.ccp4.gz", gzipped(mrc_of(wanted, {1, 0, 2}, true))), wanted);
}

TEST_F(VolumeFile, ReadsRawNumbers) {
  Volume wanted = lopsided();
  wanted.origin.setZero();
  RawLayout layout = {.size = {3, 4, 5}, .type = "float32", .spacing = {0.5, 0.25, 2.0}};
  expect_same(read("a.raw", packed<float>(wanted), layout), wanted);
  layout.type = "float64be";
  expect_same(read("b.raw.gz", gzipped(packed<double>(wanted, true)), layout), wanted);
  for (float& value : wanted.values) value = std::round(value);
  layout.type = "int16be";
  expect_same(read("c.raw", packed<std::int16_t>(wanted, true), layout), wanted);
  const auto path = write("d.raw", packed<std::int16_t>(wanted));
  for (const RawLayout& wrong :
       {RawLayout{.size = {3, 4, 1}, .type = "int16"}, RawLayout{.size = {3, 4, 5}, .type = "char"},
        RawLayout{.size = {3, 4, 5}, .type = "int16", .spacing = {1.0, 0.0, 1.0}}}) {
    EXPECT_ANY_THROW(static_cast<void>(read_volume(path, wrong)));
  }
  EXPECT_THROW(static_cast<void>(read_volume(path)), InvalidOption);
  EXPECT_THROW(static_cast<void>(read_volume(path, RawLayout{.size = {3, 4, 5}, .type = "int8"})),
               FileError);  // half of the bytes would be left
  EXPECT_THROW(static_cast<void>(read("e.cube", cube_of(wanted, 1.0, -1), layout)), InvalidOption);
}

TEST_F(VolumeFile, ReadsImagesOfVtk) {
  Volume wanted = lopsided();
  wanted.origin.setZero();
  expect_same(
      read("a.vti", vti_of("0 2 0 3 0 4", vti_piece("0 2 0 3 0 4", "PointData", text_of(wanted)))),
      wanted, 1e-5);
  // Cells stand in the middles between points; an extent may begin anywhere, and be in pieces.
  Volume lower = wanted;
  lower.values.resize(index_of(wanted.size, 0, 0, 2));
  Volume upper = wanted;
  upper.values.erase(upper.values.begin(),
                     upper.values.begin() + static_cast<std::ptrdiff_t>(lower.values.size()));
  wanted.origin = wanted.steps * Eigen::Vector3d(10.5, 0.5, 0.5);
  const Volume found = read(
      "b.vti", vti_of("10 13 0 4 0 5", vti_piece("10 13 0 4 0 2", "CellData", text_of(lower)) +
                                           vti_piece("10 13 0 4 2 5", "CellData", text_of(upper))));
  expect_same(found, wanted, 1e-5);
  EXPECT_EQ(found.notes.size(), 1u);  // of several arrays
}

TEST_F(VolumeFile, TurnsLeftHandedAxesAround) {
  Volume wanted = lopsided();
  wanted.origin.setZero();
  Volume mirrored = wanted;
  for (int z = 0; z < 5; ++z) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 3; ++x) {
        mirrored.values[index_of(wanted.size, x, y, z)] =
            wanted.values[index_of(wanted.size, 2 - x, y, z)];
      }
    }
  }
  const std::string header =
      "NRRD0004\ntype: float\ndimension: 3\nsizes: 3 4 5\nencoding: raw\nendian: little\n"
      "space directions: (-0.5,0,0) (0,0.25,0) (0,0,2)\nspace origin: (1,0,0)\n\n";
  expect_same(read("a.nrrd", header + packed<float>(mirrored)), wanted);
}

TEST_F(VolumeFile, RefusesNrrdAxesItDoesNotRead) {
  expect_refusal("axis maxs", "a.nrrd",
                 "NRRD0004\ntype: float\ndimension: 3\nsizes: 3 4 5\nencoding: raw\n"
                 "endian: little\naxis maxs: 1 1 1\n\n" +
                     packed<float>(lopsided()));
}

TEST_F(VolumeFile, SaysThatACubeHoldsMore) {
  const std::string cube = cube_of(lopsided(), 1.0, -1);
  EXPECT_EQ(read("a.cube", cube).notes, std::vector<std::string>{});
  const Volume longer = read("b.cube", cube + "7 8\n");
  EXPECT_EQ(longer.values, read("a.cube", cube).values);
  EXPECT_EQ(longer.notes, std::vector<std::string>{"values behind the last point were ignored"});
}

// Two halves of which one is written twice hold as many values as the whole.
TEST_F(VolumeFile, RefusesPiecesThatOverlap) {
  std::ostringstream half;
  for (int i = 0; i < 30; ++i) half << i << ' ';
  const std::string low = vti_piece("0 2 0 1 0 4", "PointData", half.str());
  const std::string high = vti_piece("0 2 2 3 0 4", "PointData", half.str());
  EXPECT_NO_THROW(static_cast<void>(read("whole.vti", vti_of("0 2 0 3 0 4", low + high))));
  expect_refusal("is nan", "twice.vti", vti_of("0 2 0 3 0 4", low + low));
}

TEST_F(VolumeFile, SaysWhatIsWrong) {
  const Volume volume = lopsided();
  const std::string cube = cube_of(volume, 1.0, -1);
  expect_refusal("cut short", "a.cube", cube.substr(0, cube.size() / 2));
  expect_refusal("cannot be read", "gone/a.cube", "");
  expect_refusal("where number of atoms should", "c.cube", "1\n2\nthree 0 0 0\n");
  expect_refusal("each must be from 2", "d.cube", "1\n2\n0 0 0 0\n1 1 0 0\n3 0 1 0\n3 0 0 1\n");
  const std::string nrrd = nrrd_header("float", "raw", "endian: little\n");
  expect_refusal("is it cut short", "a.nrrd", nrrd + std::string(239, 'x'));
  expect_refusal("encoding", "b.nrrd", nrrd_header("float", "bzip2"));
  expect_refusal("no field 'endian'", "c.nrrd", nrrd_header("float", "raw") + "....");
  expect_refusal("of type", "d.nrrd", nrrd_header("block", "raw", "endian: little\n"));
  expect_refusal("begin", "e.nrrd", "nothing");
  expect_refusal("damaged gzip", "f.nrrd", nrrd_header("float", "gzip", "endian: big\n") + "junk");
  const std::string map = mrc_of(volume, {0, 1, 2}, false);
  expect_refusal("cut short", "a.mrc", map.substr(0, 500));
  expect_refusal("cut short", "b.mrc", map.substr(0, 1200));
  expect_refusal("'MAP '", "c.mrc", std::string(4096, '\0'));
  expect_refusal("mode", "d.mrc", std::string(map).replace(12, 4, bytes_of(4)));
  expect_refusal("order of the axes", "e.mrc", std::string(map).replace(64, 4, bytes_of(2)));
  expect_refusal("longer than the file", "f.mrc", std::string(map).replace(92, 4, bytes_of(9999)));
  expect_refusal("span no volume", "g.mrc", std::string(map).replace(40, 4, bytes_of(0.0F)));
  expect_refusal("0 intervals", "h.mrc", std::string(map).replace(28, 4, bytes_of(0)));
  expect_refusal("no ImageData", "a.vti", "<VTKFile type=\"PolyData\"><PolyData/></VTKFile>");
  expect_refusal("WholeExtent must be", "b.vti", vti_of("0 2 0 3", ""));
  expect_refusal("its pieces hold 30 of 60", "c.vti",
                 vti_of("0 2 0 3 0 4", vti_piece("0 2 0 1 0 4", "PointData", "1")));
  expect_refusal("holds 3 values", "d.vti",
                 vti_of("0 2 0 3 0 4", vti_piece("0 2 0 3 0 4", "PointData", "1 2 3")));
  expect_refusal("outside of WholeExtent", "e.vti",
                 vti_of("0 2 0 3 0 4", vti_piece("0 9 0 3 0 4", "PointData", "1 2 3")));
  expect_refusal("must be whole numbers", "f.vti",
                 vti_of("0 2.5 0 3 0 4", vti_piece("0 2 0 3 0 4", "PointData", "1")));
  const std::string sizes = "sizes: 3 4 5";
  std::string fraction = nrrd;
  fraction.replace(fraction.find(sizes), sizes.size(), "sizes: 3 4.5 5");
  expect_refusal("'4.5' is no whole number", "h.nrrd", fraction);
  Volume holed = volume;
  holed.values[index_of(holed.size, 2, 1, 3)] = std::nanf("");
  expect_refusal("(2, 1, 3)", "g.nrrd", nrrd + packed<float>(holed));
  expect_refusal("is no volume", "a.stl", "solid");
}

}  // namespace
}  // namespace trivalent::remesh
