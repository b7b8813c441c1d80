#pragma once

#include <string>
#include <vector>

#include "trivalent/dual/build_shell.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::apps {

/// The surface that a shell is built on.
struct BuildInput {
  remesh::TriMesh mesh;
  std::vector<std::string> notes;  ///< what was changed on the way in
};

/// Reads a mesh file, or makes a built-in shape of triangles about half as long as the shell's, so
/// that it looks smooth to the shell.
[[nodiscard]] BuildInput read_build_input(const std::string& shape,
                                          const dual::ShellOptions& options);

}  // namespace trivalent::apps
