#pragma once

#include "trivalent/dual/dual_size.h"
#include "trivalent/dual/structure.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::shell {

/// The dual of a mesh at a size, as files hold it: in a padded box, with coordinations and rings.
///
/// @throws dual::InvalidNetwork if the mesh has no dual
/// @throws dual::InvalidOption if the size is out of its range
[[nodiscard]] dual::Structure structure_of(remesh::TriMesh mesh, const dual::DualSize& size);

}  // namespace trivalent::shell
