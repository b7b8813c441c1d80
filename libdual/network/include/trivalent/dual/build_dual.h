#pragma once

#include "trivalent/dual/structure.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::dual {

/// Bond length of graphene-like carbon used to size shells [Å].
inline constexpr double default_bond_length = 1.42;

/// Edge length of equilateral triangles whose centroids are one bond apart: √3 · bond.
[[nodiscard]] double edge_length_for_bond(double bond);

/// Takes the dual: one carbon atom at each face's centroid, one bond per interior edge, one ring
/// per interior vertex (atoms counter-clockwise seen from outside). Atom i belongs to face i, bonds
/// (first < second) follow the order of the edges and rings that of the vertices. The dual of a
/// periodic surface has its cell, with periodic_box(); else there is no box.
///
/// @throws InvalidNetwork if the mesh has no faces, or an interior vertex has valence 2.
[[nodiscard]] Structure build_dual(const remesh::TriMesh& mesh);

/// Mean bond length [Å]; 0 without bonds.
[[nodiscard]] double mean_bond_length(const Structure& structure);

}  // namespace trivalent::dual
