#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A mesh from a file, and what reading it changed.
struct MeshFile {
  TriMesh mesh;
  std::vector<std::string> notes;  ///< one sentence per kind of change, e.g. "split 12 quads"
};

/// Reads OFF, OBJ, PLY, STL, VTK (legacy), VTP or VTU, text or binary, also gzipped.
///
/// Where content and extension disagree, or there is no extension (/dev/stdin), the content
/// decides. Splits polygons into triangles, welds corners of STL files that are equal or differ by
/// rounding, and drops isolated vertices; notes say so. Checks every count that the file declares
/// against the file's size before allocating memory.
///
/// @throws FileError   if the file is missing, unreadable, of an unknown kind, cut short, malformed
///   or without faces; the message names the line, byte or element.
/// @throws InvalidMesh if the faces do not form an oriented 2-manifold; the message names the
///   element, and repair() may help.
///
/// Cost: O(n) for n bytes; a million faces in OFF take about a second.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path);

/// Writes OFF, OBJ, PLY (text) or STL (binary, 32-bit numbers), by extension; of a periodic surface
/// the faces of one cell, as soup_of() gives them. Coordinates in text have as many digits as are
/// needed to read the same bits back. The file appears whole or not at all.
///
/// @throws FileError   if the extension is unknown or the file cannot be written.
/// @throws InvalidMesh if a coordinate is not finite.
void write_mesh(const TriMesh& mesh, const std::filesystem::path& path);

}  // namespace trivalent::remesh
