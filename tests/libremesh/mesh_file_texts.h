#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <string>
#include <vector>

#include "mesh_fixtures.h"
#include "temporary_folder.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"

/// Texts of mesh files, and what is expected of reading them.
namespace trivalent::remesh {

using Notes = std::vector<std::string>;

/// Text of a right-angled tetrahedron, volume 1/6, after which tests may put more.
inline const std::string off_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
inline const std::string off_faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
inline const std::string off_text = "OFF\n4 4 0\n" + off_points + off_faces;
inline const std::string obj_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
inline const std::string obj_text = obj_points + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

inline void expect_tetrahedron(const PolygonSoup& soup, const Notes& notes = {}) {
  const TriangleSoup triangles = triangulate(soup);
  EXPECT_EQ(triangles.notes, notes);
  const TriMesh mesh = make_mesh(triangles.points, triangles.triangles);
  EXPECT_EQ(mesh.n_vertices(), 4u);
  EXPECT_EQ(mesh.n_faces(), 4u);
  EXPECT_NEAR(testing_support::signed_volume(mesh), 1.0 / 6.0, 1e-15);
}

/// What parsing says against the bytes; empty if it accepts them.
inline std::string refusal(std::string_view bytes, const std::string& name) {
  return testing_support::message_of<FileError>([&] { (void)parse_polygon_soup(bytes, name); });
}

inline void expect_refusal(std::string_view bytes, const std::string& name,
                           std::string_view reason) {
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

/// The same tetrahedron as numbers.
inline const std::vector<std::array<float, 3>> tetrahedron_points = {
    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<std::array<int, 3>> tetrahedron_faces = {
    {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

}  // namespace trivalent::remesh
