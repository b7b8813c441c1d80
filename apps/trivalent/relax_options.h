#pragma once

#include "session.h"
#include "trivalent/shell/relax.h"

namespace trivalent::apps {

[[nodiscard]] Grammar grammar_of_relax();

/// What the command line of relax says; notes and LAMMPS's progress go to the session's terminal,
/// which must outlive it.
///
/// @throws UsageError if the options make no sense.
[[nodiscard]] shell::RelaxOptions relax_options(const Session& session);

}  // namespace trivalent::apps
