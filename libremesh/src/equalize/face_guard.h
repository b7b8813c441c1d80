#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// True if no face at v turns over or degenerates when v moves to `position`, and no edge gets too
/// long for the lattice. Faces that also contain `except` do not count: they vanish in the collapse
/// of that edge.
[[nodiscard]] bool faces_stay_upright(const TriMesh& mesh, VertexHandle v,
                                      const Eigen::Vector3d& position,
                                      VertexHandle except = VertexHandle());

/// True if flipping e makes two faces that look the same way as those it replaces, and an edge not
/// too long for the lattice.
[[nodiscard]] bool flip_stays_upright(const TriMesh& mesh, EdgeHandle e);

}  // namespace trivalent::remesh
