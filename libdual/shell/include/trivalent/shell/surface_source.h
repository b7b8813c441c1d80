#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/shell/build_shell.h"

namespace trivalent::shell {

/// A built-in shape and its parameters, as in "torus:R=3,r=1".
struct ShapeCall {
  std::string name;
  std::vector<remesh::ShapeArgument> arguments;
};
/// @throws remesh::InvalidOption if parameters are not name=number.
[[nodiscard]] ShapeCall parse_shape(std::string_view text);

/// Whether the text, up to its first colon, is the name of a built-in shape.
[[nodiscard]] bool is_built_in(std::string_view text);

/// Reads points and triangles from a file, or from standard input if the path is "-".
[[nodiscard]] remesh::TriangleSoup read_soup(const std::string& path);

/// The surface a shell is built on.
struct Surface {
  remesh::TriMesh mesh;
  std::vector<std::string> notes = {};  ///< what was changed on the way in
  double wrap_offset = 0.0;  ///< distance from the input to its wrap [unit of the input]; 0 if not
                             ///< wrapped
};

/// Repairs triangles that are to become a shell.
///
/// @param repair  its edge_length_on is set here
/// @throws remesh::InvalidMesh if no surface results
/// @throws remesh::InvalidOption, dual::InvalidOption if an option is out of its range
[[nodiscard]] Surface repair_surface(const remesh::TriangleSoup& soup,
                                     const dual::ShellOptions& shell,
                                     remesh::RepairOptions repair = {});

/// Reads a mesh file and repairs it, or makes a built-in shape of triangles about half as long as
/// the shell's, so that it looks smooth to the shell.
///
/// @param source  a path, "-" for standard input, or a built-in shape as parse_shape() takes it
/// @param repair  its edge_length_on is set here
/// @throws remesh::FileError, remesh::InvalidMesh if no surface results
/// @throws remesh::InvalidOption, dual::InvalidOption if an option is out of its range
[[nodiscard]] Surface read_surface(const std::string& source, const dual::ShellOptions& shell,
                                   remesh::RepairOptions repair = {});

}  // namespace trivalent::shell
