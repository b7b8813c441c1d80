#pragma once

#include <array>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// The periodic surface of which a free mesh shows one cell: joins boundary vertices that are
/// images of each other. Edges that are long for the lattice are halved first.
///
/// @param mesh  Its open boundaries lie where it goes on in the next cell. If a direction is not
///   periodic, others may be edges, which stay open.
/// @throws InvalidMesh if a boundary vertex has no partner (the message says where, and how far off
///   the nearest image of another one is) and is no such edge, if the joined faces are no surface,
///   or if they meet their own images.
[[nodiscard]] TriMesh joined_in_cell(TriMesh mesh, const Lattice& lattice);

/// A supercell: the surface in a cell so many times as long.
///
/// @param times  Along each cell vector, >= 1; 1 where nothing is periodic.
/// @throws InvalidOption if a number is out of its range, or the supercell would have more than
///   max_faces.
[[nodiscard]] TriMesh repeated(const TriMesh& mesh, const std::array<int, 3>& times);

/// A supercell of any shape.
///
/// @param cell  Its vectors are sums of whole multiples of the mesh's; three are periodic.
/// @throws InvalidOption if they are not, or the supercell would have more than max_faces.
[[nodiscard]] TriMesh in_supercell(const TriMesh& mesh, const Lattice& cell);

}  // namespace trivalent::remesh
