#pragma once

#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// @throws InvalidMesh, InvalidOption  as remesh() does.
void check_remeshable(const TriMesh& mesh, const RemeshOptions& options);

}  // namespace trivalent::remesh
