#pragma once

#include <string>
#include <vector>

#include "session.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/structure_source.h"
#include "trivalent/view/shell_state.h"

namespace trivalent::apps {

/// Commands that show atoms take FILE..., how to read them, and a potential for their energies.
void add_states_options(Grammar& grammar);

struct StatesRequest {
  std::vector<std::string> files;
  std::vector<std::string> names;  ///< one per file
  shell::StructureOptions reading;
  shell::PotentialChoice potential;
};

/// @throws UsageError if the options make no sense.
[[nodiscard]] StatesRequest states_request(const Session& session);

/// All files with their energies. Where the last has the atoms of the first, it knows how far they
/// moved.
[[nodiscard]] std::vector<dual::ShellState> read_states(const StatesRequest& request,
                                                        const Terminal& terminal);

}  // namespace trivalent::apps
