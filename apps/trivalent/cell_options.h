#pragma once

#include <string>

#include "session.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::apps {

/// The cell of which a mesh file shows one.
void add_mesh_cell_options(po::options_description& options);
[[nodiscard]] shell::CellOptions mesh_cell_options(const Session& session);

/// The same, and what formulas and volumes need.
void add_cell_options(po::options_description& options);

/// @throws UsageError if the options contradict each other.
[[nodiscard]] shell::CellOptions cell_options(const Session& session);

/// What read_surface() is to read: SHAPE, or the formula.
///
/// @throws UsageError if both are given, or none.
[[nodiscard]] std::string surface_name(const Session& session);

}  // namespace trivalent::apps
