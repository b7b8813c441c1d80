#pragma once

#include "session.h"
#include "trivalent/shell/potential_choice.h"

namespace trivalent::apps {

/// --potential, --lj-epsilon, --lj-sigma, --lj-cutoff, --lj-shift, and those of pair styles.
void add_potential_options(po::options_description& options);

/// --pair-style and --pair-coeff.
void add_pair_options(po::options_description& options);

/// @throws UsageError if only one of the two is given.
[[nodiscard]] std::optional<dual::PairStyle> pair_style(const Session& session);

/// @throws UsageError if there is no such potential, or two are named.
[[nodiscard]] shell::PotentialChoice potential_choice(const Session& session);

}  // namespace trivalent::apps
