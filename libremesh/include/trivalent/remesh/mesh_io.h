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

/// Reads OFF, OBJ, PLY or STL (text or binary, by extension and content).
///
/// Polygons are split into triangles and vertices of STL files welded; both are noted. Counts that
/// the header declares are compared with what the file holds.
///
/// @throws FileError   if the file is missing, unreadable, of an unknown kind, cut short or malformed;
///   the message names the line, byte or element.
/// @throws InvalidMesh if the faces do not form an oriented 2-manifold; the message names the element.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path);

/// Writes OFF, OBJ, PLY (text) or STL (binary), by extension. Coordinates of the text kinds carry 17
/// significant digits, so that they read back to the same bits. The file appears whole or not at all.
///
/// @throws FileError if the extension is unknown or the file cannot be written.
void write_mesh(const TriMesh& mesh, const std::filesystem::path& path);

}  // namespace trivalent::remesh
