#pragma once

#include <string>

#include "session.h"
#include "trivalent/dual/structure.h"

namespace trivalent::apps {

/// --periodic, and --length, --scale and --bond for the dual of a mesh.
void add_structure_options(po::options_description& options);

/// @throws UsageError if the options make no sense.
void check_structure_options(const Session& session);

/// Reads extended XYZ, LAMMPS data, or a mesh, whose dual is meant; tells the terminal what was
/// left out. Bonds and rings are known of a mesh's dual, bonds of molecular LAMMPS data.
[[nodiscard]] dual::Structure read_structure(const std::string& path, const Session& session);

}  // namespace trivalent::apps
