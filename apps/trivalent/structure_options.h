#pragma once

#include <array>
#include <string>

#include "session.h"
#include "trivalent/shell/structure_source.h"

namespace trivalent::apps {

/// The option for the atom_style of what is read, where --atom-style is what the command writes.
inline const std::string input_style = "input-atom-style";

/// How to read atoms: --periodic, --format, --elements, --frame and the atom_style of LAMMPS data;
/// and --length, --scale and --bond for the dual of a mesh.
///
/// @param style_option  input_style where --atom-style is what the command writes
void add_structure_options(po::options_description& options,
                           const std::string& style_option = "atom-style");

/// @throws UsageError if the options make no sense.
[[nodiscard]] shell::StructureOptions structure_options(
    const Session& session, const std::string& style_option = "atom-style");

/// Directions out of a text such as xyz, z or none.
///
/// @throws UsageError if it is no such text.
[[nodiscard]] std::array<bool, 3> periodic_directions(const std::string& text);

/// Reads a structure and tells the terminal what was left out or assumed.
[[nodiscard]] dual::Structure read_structure(const std::string& path,
                                             const shell::StructureOptions& options,
                                             const Terminal& terminal);

}  // namespace trivalent::apps
