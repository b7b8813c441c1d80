#pragma once

#include "session.h"
#include "trivalent/remesh/remesh.h"

namespace trivalent::apps {

/// --method, --iterations, --rings, --sigma, --restriction and --feature-angle.
void add_remesh_options(po::options_description& options);

/// What they say; target_edge_length is left open, and progress goes to the terminal.
///
/// @throws UsageError if a name is unknown.
[[nodiscard]] remesh::RemeshOptions remesh_options(const Session& session);

}  // namespace trivalent::apps
