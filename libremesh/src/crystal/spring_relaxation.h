#pragma once

#include <functional>
#include <vector>

#include "crystal/spring_step.h"
#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Where every vertex may move, by its number.
[[nodiscard]] std::vector<MotionFrame> motion_frames(const ConstrainedMesh& constrained);

/// Moves all vertices over the surface towards the minimum of Σ (|e|/L - 1)², one after the other
/// (Gauss-Seidel, overrelaxed): each goes to the minimum of its own edges' energy in its tangent
/// plane, or along its feature curve. Then all are projected; no face turns over.
///
/// @param should_stop  Asked every few sweeps; once it returns true, the rest are left out.
void relax_springs(ConstrainedMesh& constrained, double length, int sweeps,
                   const std::function<bool()>& should_stop = {});

/// The same for a net that is at rest on the surface but for a small step off it: vertices move in
/// their tangent planes only, and are not projected.
void settle_springs(ConstrainedMesh& constrained, double length, int sweeps);

/// Mean of (|e|/L - 1)² over the edges.
[[nodiscard]] double spring_strain(const TriMesh& mesh, double length);

}  // namespace trivalent::remesh
