#pragma once

#include <vector>

#include "session.h"
#include "trivalent/view/shell_state.h"

namespace trivalent::apps {

/// Commands that show atoms take FILE..., how to read them, and a potential for their energies.
void add_states_options(Grammar& grammar);

/// @throws UsageError if the options make no sense.
void check_states_options(const Session& session);

/// All files with their energies, named after them. Where the last has the first one's atoms, it
/// knows how far they moved.
[[nodiscard]] std::vector<dual::ShellState> read_states(const Session& session);

}  // namespace trivalent::apps
