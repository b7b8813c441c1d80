#pragma once

#include "interruption.h"
#include "session.h"
#include "trivalent/remesh/crystallize.h"

namespace trivalent::apps {

/// --method, --effort, --seed and --feature-angle, and the paper's --iterations, --rings, --sigma
/// and --restriction.
void add_remesh_options(po::options_description& options);

/// The method they name, with its options; target_edge_length is left open, and progress goes to
/// the session's terminal, which must outlive it.
///
/// @throws UsageError if a name is unknown, or an option belongs to the other method.
[[nodiscard]] remesh::RemeshMethod remesh_method(const Session& session);

/// Lets the request end the method; it must outlive the method's run.
void stop_with(remesh::RemeshMethod& method, const StopRequest& stop);

}  // namespace trivalent::apps
