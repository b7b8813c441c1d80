#pragma once

#include <filesystem>
#include <iosfwd>

#include "trivalent/view/shell_state.h"

namespace trivalent::dual {

/// Writes VTK PolyData, as ParaView and VTK read it: a vertex per atom, a line per bond, a polygon
/// per ring; none across a periodic boundary. Points carry `id` (from 1), `atomic_number` and all
/// maps; cells `bond_length` [Å] (lines, else not a number) and `ring_size` (polygons, else 0).
///
/// @throws InvalidNetwork as check_state.
void write_vtp(std::ostream& out, const ShellState& state);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_vtp(const std::filesystem::path& path, const ShellState& state);

}  // namespace trivalent::dual
