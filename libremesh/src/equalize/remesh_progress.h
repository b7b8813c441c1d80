#pragma once

#include "trivalent/remesh/remesh.h"

namespace trivalent::remesh {

/// Edge lengths and valences of a mesh, which may hold deleted elements; `iteration` and
/// `iterations` stay 0.
[[nodiscard]] RemeshProgress measure_progress(const TriMesh& mesh);

}  // namespace trivalent::remesh
