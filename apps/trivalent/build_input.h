#pragma once

#include <string>
#include <vector>

#include "build_plan.h"
#include "session.h"
#include "trivalent/remesh/mesh.h"
#include "trivalent/shell/build_shell.h"

namespace trivalent::apps {

/// The surface that a shell is built on.
struct BuildInput {
  remesh::TriMesh mesh;
  std::vector<std::string> notes;  ///< what was changed on the way in
  double wrap_offset = 0.0;        ///< from the input to its wrap, in its unit; 0 if not wrapped
};

/// Reads a mesh file and mends it, or makes a built-in shape of triangles about half as long as the
/// shell's, so that it looks smooth to the shell.
[[nodiscard]] BuildInput read_build_input(const Session& session,
                                          const dual::ShellOptions& options);

/// Refuses a build that cannot succeed.
///
/// @throws remesh::InvalidMesh with the first obstacle.
void check_plan(const BuildPlan& plan);

}  // namespace trivalent::apps
