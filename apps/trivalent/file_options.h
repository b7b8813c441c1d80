#pragma once

#include "session.h"
#include "trivalent/formats/digits.h"
#include "trivalent/formats/lammps_data.h"

namespace trivalent::apps {

/// --digits.
void add_digits_option(po::options_description& options);
/// --digits and --atom-style.
void add_file_options(po::options_description& options);

/// @throws UsageError if the name is unknown.
[[nodiscard]] dual::Digits digits(const Session& session);

/// @throws UsageError if the name is unknown.
[[nodiscard]] dual::AtomStyle atom_style(const Session& session);

}  // namespace trivalent::apps
