#pragma once

#include "session.h"
#include "trivalent/shell/potential_choice.h"

namespace trivalent::apps {

/// --potential, and --lj-epsilon, --lj-sigma, --lj-cutoff, --lj-shift.
void add_potential_options(po::options_description& options);

/// @throws UsageError if there is no such potential.
[[nodiscard]] shell::PotentialChoice potential_choice(const Session& session);

}  // namespace trivalent::apps
