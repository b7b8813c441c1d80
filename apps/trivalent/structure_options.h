#pragma once

#include <string>

#include "session.h"
#include "trivalent/shell/structure_source.h"

namespace trivalent::apps {

/// --periodic, and --length, --scale and --bond for the dual of a mesh.
void add_structure_options(po::options_description& options);

/// @throws UsageError if the options make no sense.
[[nodiscard]] shell::StructureOptions structure_options(const Session& session);

/// Reads a structure and tells the terminal what was left out or assumed.
[[nodiscard]] dual::Structure read_structure(const std::string& path,
                                             const shell::StructureOptions& options,
                                             const Terminal& terminal);

}  // namespace trivalent::apps
