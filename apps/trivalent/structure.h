#pragma once

#include <string>

#include "session.h"
#include "trivalent/dual/network.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/view/shell_state.h"

namespace trivalent::apps {

/// Atoms to work on, and the network they form as far as the input tells: bonds and rings of a
/// mesh's dual, bonds of molecular LAMMPS data, else only positions.
struct Structure {
  dual::XyzFrame frame;
  dual::Network network;
};

/// --periodic, and --length, --scale and --bond for the dual of a mesh.
void add_structure_options(po::options_description& options);

/// @throws UsageError if the options make no sense.
void check_structure_options(const Session& session);

/// Reads extended XYZ, LAMMPS data, or a mesh, whose dual is meant; tells the terminal what was
/// left out.
[[nodiscard]] Structure read_structure(const std::string& path, const Session& session);

/// What is to be seen of a structure; bonds and rings are found unless the input was a mesh.
[[nodiscard]] dual::ShellState state_of(const Structure& structure);

}  // namespace trivalent::apps
