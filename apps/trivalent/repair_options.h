#pragma once

#include "session.h"
#include "trivalent/remesh/mesh_repair.h"

namespace trivalent::apps {

/// --repair, --holes, --components, --wrap-alpha and --wrap-offset.
void add_repair_options(po::options_description& options);

/// @throws UsageError if a name is unknown.
[[nodiscard]] remesh::RepairOptions repair_options(const Session& session);

}  // namespace trivalent::apps
