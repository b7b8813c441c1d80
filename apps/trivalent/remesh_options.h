#pragma once

#include <optional>

#include "interruption.h"
#include "session.h"
#include "trivalent/remesh/crystallize.h"

namespace trivalent::apps {

/// --method, --effort, --seed and --feature-angle, and the paper's --iterations, --rings, --sigma
/// and
/// --restriction.
void add_remesh_options(po::options_description& options);

/// The method they name, with its options; target_edge_length is left open, and progress goes to
/// the terminal.
///
/// @param stop  Made here for a method that can end early with the best net so far, and asked by
/// it;
///              to be kept while the method runs.
/// @throws UsageError if a name is unknown, or an option belongs to the other method.
[[nodiscard]] remesh::RemeshMethod remesh_method(const Session& session,
                                                 std::optional<StopRequest>& stop);

/// What to say of a net that was stopped early.
[[nodiscard]] std::string stopped_note(const remesh::RemeshResult& result);

}  // namespace trivalent::apps
