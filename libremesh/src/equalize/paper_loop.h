#pragma once

#include <functional>

#include "equalize/check_remeshable.h"
#include "equalize/constrained_mesh.h"
#include "equalize/divide_edges.h"
#include "equalize/remesh_progress.h"
#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// remesh() on a mesh that is bound to its surface and was found remeshable. Calls after_iteration
/// instead of options.on_progress.
///
/// @return  False if options.should_stop ended it; the mesh is then sound, but its edges are not of
///   the target length.
bool remesh_in_place(ConstrainedMesh& constrained, const RemeshOptions& options,
                     const std::function<void(const RemeshProgress&)>& after_iteration);

}  // namespace trivalent::remesh
