#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Points and polygons of a file: every index is in range and every coordinate finite; how the
/// polygons connect is not known.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<int> corners;        ///< of all polygons, one after the other; indices into points
  std::vector<std::size_t> ends;   ///< one per polygon: where its corners end
  std::vector<std::string> notes;  ///< one sentence per kind of change made while reading

  [[nodiscard]] std::span<const int> polygon(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
};

/// Points and triangles that have at least three different corners each.
struct TriangleSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::string> notes;  ///< those of the polygons, and of later changes
};

/// The box around one or more points.
[[nodiscard]] BoundingBox bounding_box(std::span<const Eigen::Vector3d> points);

/// Reads the points and polygons of a mesh file, or points alone, one per line (.xyz, .pwn). Kinds
/// of files and errors are those of read_mesh().
[[nodiscard]] PolygonSoup read_polygon_soup(const std::filesystem::path& path);

/// The same for the bytes of a file, which may be gzipped. Its name gives the extension, and is
/// used in messages. Memory: a small multiple of the unpacked bytes.
[[nodiscard]] PolygonSoup parse_polygon_soup(std::string_view bytes, const std::string& name);

/// Whether a file's name has an extension that read_polygon_soup knows.
[[nodiscard]] bool has_mesh_extension(const std::filesystem::path& path);

/// Splits polygons into triangles: quads along the shorter diagonal that lies inside, convex
/// polygons into fans, others by cutting off ears in their mean plane. Never along an edge that
/// exists already; where every diagonal does, a point is added. Merges repeated corners and drops
/// polygons left with fewer than three; notes say so.
///
/// @throws InvalidMesh if a polygon that is not convex has more than 1000 corners.
[[nodiscard]] TriangleSoup triangulate(const PolygonSoup& soup);

/// The faces of a mesh as they lie in space. Of a periodic surface that is one cell, in which a
/// vertex has a point for each of its images that faces reach.
[[nodiscard]] TriangleSoup soup_of(const TriMesh& mesh);

}  // namespace trivalent::remesh
