#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A mesh as it was read, and what was changed on the way in.
struct MeshFile {
  TriMesh mesh;
  std::vector<std::string> notes;  ///< one sentence per kind of change, e.g. "split 12 quads"
};

/// Reads OFF, OBJ, PLY, STL, VTK (legacy), VTP or VTU, text or binary, also gzipped.
///
/// The content decides where it disagrees with the extension, or there is none (/dev/stdin).
/// Polygons are split into triangles, corners of STL files welded where their coordinates are
/// equal or differ by rounding, isolated vertices dropped; all is noted. A count that the file
/// declares is held against its size before memory is taken for it.
///
/// @throws FileError   if the file is missing, unreadable, of an unknown kind, cut short, malformed
///   or without faces; the message names the line, byte or element.
/// @throws InvalidMesh if the faces do not form an oriented 2-manifold; the message names the
///   element, and repair() may help.
///
/// Cost: O(n) for n bytes; a million faces in OFF take about a second.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path);

/// Writes OFF, OBJ, PLY (text) or STL (binary, 32-bit numbers), by extension. Coordinates of the
/// text kinds carry as many digits, up to 17, as bring back the same bits. The file appears whole
/// or not at all.
///
/// @throws FileError   if the extension is unknown or the file cannot be written.
/// @throws InvalidMesh if a coordinate is infinite or no number.
void write_mesh(const TriMesh& mesh, const std::filesystem::path& path);

}  // namespace trivalent::remesh
