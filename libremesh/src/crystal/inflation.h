#pragma once

#include <optional>

#include "equalize/constrained_mesh.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Whether most of the area is too thin for nets of this edge length: thinner than half of it, so
/// that they would lose the shape even if it were inflated.
[[nodiscard]] bool is_too_thin(const ConstrainedMesh& on_surface, double length);

/// The same surface with its thin parts inflated to about the given thickness, so that a net of
/// long edges can lie on both sides of them. Vertices on curves stay.
///
/// @param on_surface  The surface itself, as its net at the start.
/// @return Nothing if no part is thinner.
std::optional<TriMesh> inflated(const ConstrainedMesh& on_surface, double thickness);

/// A net on one of two surfaces with the same faces, carried over to the other.
ConstrainedMesh::State carried_over(const ConstrainedMesh::State& net, const TriMesh& from,
                                    const TriMesh& to);

}  // namespace trivalent::remesh
