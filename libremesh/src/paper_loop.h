#pragma once

#include <functional>

#include "constrained_mesh.h"
#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// @throws InvalidMesh, InvalidOption  as remesh() does.
void check_remeshable(const TriMesh& mesh, const RemeshOptions& options);

/// remesh() on a mesh whose vertices are bound to their surface already and that was found
/// remeshable; options.on_progress is left to the caller.
void remesh_in_place(ConstrainedMesh& constrained, const RemeshOptions& options,
                     const std::function<void(const RemeshProgress&)>& after_iteration);

/// Where a mesh stands; `iteration` and `iterations` are left open.
[[nodiscard]] RemeshProgress measure_progress(const TriMesh& mesh);

}  // namespace trivalent::remesh
