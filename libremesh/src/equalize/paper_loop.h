#pragma once

#include <functional>

#include "equalize/constrained_mesh.h"
#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// @throws InvalidMesh, InvalidOption  as remesh() does.
void check_remeshable(const TriMesh& mesh, const RemeshOptions& options);

/// The same surface, where edges that end at a crease and are long against the target length are
/// halved, the longest first, so that faces keep their shape. At the corners of faces far larger
/// than those of a net the normals are means over half of a solid, and its first edges would cut
/// creases deeply. Fewer are halved if that made many more faces than a net has.
[[nodiscard]] TriMesh with_edges_divided(const TriMesh& surface, double target);

/// remesh() on a mesh whose vertices are bound to their surface already and that was found
/// remeshable; options.on_progress is left to the caller.
void remesh_in_place(ConstrainedMesh& constrained, const RemeshOptions& options,
                     const std::function<void(const RemeshProgress&)>& after_iteration);

/// Where a mesh stands; `iteration` and `iterations` are left open.
[[nodiscard]] RemeshProgress measure_progress(const TriMesh& mesh);

}  // namespace trivalent::remesh
