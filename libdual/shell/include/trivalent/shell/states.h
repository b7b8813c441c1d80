#pragma once

#include <string>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/shell/json.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/view/shell_page.h"
#include "trivalent/view/shell_state.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// A structure and what to call it.
struct NamedStructure {
  std::string name;
  dual::Structure structure;
};

/// Structures with their energies, as pictures and pages show them. Where the last has the atoms of
/// the first, it knows how far they moved.
///
/// @param structures  at least one, in the order of their making
/// @throws what evaluate() throws
[[nodiscard]] std::vector<dual::ShellState> evaluate_states(std::vector<NamedStructure> structures,
                                                            const PotentialChoice& potential);

/// A page that shows states with a table of their energies, named after the last.
[[nodiscard]] dual::ShellPage page_of(std::vector<dual::ShellState> states,
                                      const PotentialChoice& potential);

}  // namespace trivalent::shell
