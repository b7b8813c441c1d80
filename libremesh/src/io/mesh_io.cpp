#include "trivalent/remesh/mesh_io.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <ostream>
#include <string_view>

#include "io/binary_numbers.h"
#include "io/mesh_readers.h"
#include "mesh/geometry.h"
#include "repair/soup_repair.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::remesh {

namespace {

// ---- writing -----------------------------------------------------------------------------------

/// The shortest digits that read back to the same bits.
void write_number(std::ostream& out, double value) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.write(digits.data(), end - digits.data());
}

void write_position(std::ostream& out, const Eigen::Vector3d& p) {
  write_number(out, p.x());
  out.put(' ');
  write_number(out, p.y());
  out.put(' ');
  write_number(out, p.z());
  out.put('\n');
}

void write_vertices(std::ostream& out, const TriangleSoup& mesh, std::string_view prefix) {
  for (const Eigen::Vector3d& p : mesh.points) {
    out << prefix;
    write_position(out, p);
  }
}

/// One line per face, with indices from `first`.
void write_faces(std::ostream& out, const TriangleSoup& mesh, std::string_view prefix, int first) {
  for (const auto& triangle : mesh.triangles) {
    out << prefix;
    for (const int v : triangle) out << ' ' << v + first;
    out.put('\n');
  }
}

void write_off(std::ostream& out, const TriangleSoup& mesh) {
  out << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
  write_vertices(out, mesh, "");
  write_faces(out, mesh, "3", 0);
}

void write_obj(std::ostream& out, const TriangleSoup& mesh) {
  write_vertices(out, mesh, "v ");
  write_faces(out, mesh, "f", 1);
}

void write_ply(std::ostream& out, const TriangleSoup& mesh) {
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  write_vertices(out, mesh, "");
  write_faces(out, mesh, "3", 0);
}

void write_floats(std::ostream& out, const Eigen::Vector3d& p) {
  for (const double x : p)
    write_little_endian(out, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
}

void write_stl(std::ostream& out, const TriangleSoup& mesh) {
  // Must not begin with "solid", the mark of text files.
  std::array<char, 80> header{};
  std::string_view("binary STL, written by trivalent").copy(header.data(), header.size());
  out.write(header.data(), header.size());
  write_little_endian(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangle[k]);
      corners[k] = mesh.points[v];
      if (corners[k].cast<float>().allFinite()) continue;
      throw FileError(concat("write_mesh: vertex ", v, " is too far out for STL's 32-bit numbers"));
    }
    write_floats(out, unit_normal(corners));
    for (const Eigen::Vector3d& corner : corners) write_floats(out, corner);
    out.put(0).put(0);  // attribute
  }
}

using Writer = void (*)(std::ostream&, const TriangleSoup&);

Writer writer_for(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".off") return write_off;
  if (extension == ".obj") return write_obj;
  if (extension == ".ply") return write_ply;
  if (extension == ".stl") return write_stl;
  throw FileError(concat("write_mesh: ", path.string(), ": unknown extension '", extension,
                         "'; known are .off, .obj, .ply and .stl"));
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path) {
  TriangleSoup soup = triangulate(read_polygon_soup(path));
  if (soup.triangles.empty()) {
    throw FileError(concat("read_mesh: ", path.string(), ": holds no faces"));
  }
  // Before points are dropped, so that messages count as the file does.
  MeshFile file{make_mesh(soup.points, soup.triangles), std::move(soup.notes)};
  const std::size_t dropped = drop_isolated_points(soup);
  if (dropped > 0) {
    file.mesh = make_mesh(soup.points, soup.triangles);
    file.notes.push_back(dropped == 1 ? "dropped 1 isolated vertex"
                                      : concat("dropped ", dropped, " isolated vertices"));
  }
  return file;
}

void write_mesh(const TriMesh& mesh, const std::filesystem::path& path) {
  const Writer write = writer_for(path);
  for (const auto v : mesh.vertices()) {
    if (mesh.point(v).allFinite()) continue;
    throw InvalidMesh(
        concat("write_mesh: vertex ", v.idx(), " is at no finite position; nothing was written"));
  }
  write_whole_file(path, [&](std::ostream& out) { write(out, soup_of(mesh)); });
}

}  // namespace trivalent::remesh
