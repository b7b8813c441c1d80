#pragma once

#include "session.h"
#include "trivalent/formats/lammps_data.h"

namespace trivalent::apps {

/// --digits and --atom-style.
void add_file_options(po::options_description& options);

/// --digits: decimals or 17.
///
/// @throws UsageError on anything else.
[[nodiscard]] dual::Digits digits(const Session& session);

/// --atom-style: atomic or molecular.
///
/// @throws UsageError on anything else.
[[nodiscard]] dual::AtomStyle atom_style(const Session& session);

}  // namespace trivalent::apps
