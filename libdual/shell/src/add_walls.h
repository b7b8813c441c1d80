#pragma once

#include <functional>
#include <vector>

#include "trivalent/shell/build_shell.h"

namespace trivalent::dual {

/// @throws InvalidOption if an option is out of its range.
void check_wall_options(const WallOptions& walls);

/// About the areas [Å²] of the walls of a surface, the given one first: Steiner's formula
/// [Steiner1840], 0 where nothing is left.
///
/// @param scale  [Å per unit of the mesh]
[[nodiscard]] std::vector<double> areas_of_walls(const remesh::TriMesh& mesh, double scale,
                                                 const WallOptions& walls);

/// The scale [Å per unit of the mesh] at which the walls have so much area together [Å²].
[[nodiscard]] double scale_for_area(const remesh::TriMesh& mesh, double area,
                                    const WallOptions& walls);

/// How the net of each wall is made.
struct NetMaker {
  double edge_length;  ///< of nets at rest [Å]
  /// Makes the net of a surface in Å, beside another net, with about so many faces.
  std::function<remesh::RemeshResult(const remesh::TriMesh& surface, const remesh::TriMesh& beside,
                                     double faces)>
      make;
};

/// Adds walls to a shell of one, net by net: each is a net of the surface at the given distance
/// from the net before, so that walls follow each other where they leave the surface. Nets with an
/// edge do not leave it, and each is one of the given surface moved by so many distances.
///
/// @param given  The surface of the shell's first wall [Å].
/// @throws remesh::InvalidMesh if there is no room for so many; the message says for how many.
void add_walls(Shell& shell, remesh::TriMesh given, const WallOptions& walls,
               const NetMaker& maker);

}  // namespace trivalent::dual
