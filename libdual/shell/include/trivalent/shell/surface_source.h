#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/remesh/volume.h"
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

/// The cell of a surface, in its own unit.
struct CellOptions {
  /// Of which a mesh file shows one cell, or under which a formula repeats. For a formula without
  /// periodic directions, the box around its closed surface.
  std::optional<remesh::Lattice> lattice = {};
  double level = 0.0;  ///< value of a formula or volume on the surface
  /// Axes along which a volume repeats, or cell vectors along which a mesh does; none: a volume
  /// does not, a mesh along those of the lattice.
  remesh::Lattice::Periodic periodic = {};
  std::optional<remesh::RawLayout> raw = {};  ///< what a .raw file holds
  std::array<int, 3> supercell = {1, 1, 1};   ///< cells along each vector, >= 1
};

/// Reads a cell: a, or a,b,c or a,b,c,alpha,beta,gamma, lengths in the surface's unit, angles in
/// degree; a lies along x then, b in the xy plane. Or nine coordinates of the vectors, one vector
/// after the other. Each number is a formula such as 2*pi.
///
/// @throws remesh::InvalidOption if it is no such cell, or lengths and angles have no volume.
[[nodiscard]] remesh::Lattice::Cell parse_cell(const std::string& text);

/// Reads what a .raw file holds: nx,ny,nz,type with a spacing, or one for each axis, behind.
///
/// @throws remesh::InvalidOption if it is no such layout.
[[nodiscard]] remesh::RawLayout parse_raw_layout(const std::string& text);

/// What marks a source as a formula of x, y and z.
inline constexpr std::string_view formula_prefix = "formula:";

/// Reads a mesh file and repairs it, or makes a built-in shape or the surface of a formula or a
/// volume of triangles about half as long as the shell's, so that it looks smooth to the shell.
///
/// @param source  the path of a mesh or a volume, "-" for a mesh on standard input, a built-in
/// shape
///   as parse_shape() takes it, or formula_prefix and a formula
/// @param repair  its edge_length_on is set here
/// @throws remesh::FileError, remesh::InvalidMesh if no surface results
/// @throws remesh::InvalidOption, dual::InvalidOption if an option is out of its range
[[nodiscard]] Surface read_surface(const std::string& source, const dual::ShellOptions& shell,
                                   remesh::RepairOptions repair = {}, const CellOptions& cell = {});

/// Joins a mesh that shows one cell, if a cell is given, and repeats it.
///
/// @throws as remesh::joined_in_cell() and remesh::repeated().
[[nodiscard]] Surface in_cell(Surface surface, const CellOptions& cell);

}  // namespace trivalent::shell
