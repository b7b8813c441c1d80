#pragma once

#include <string_view>

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Refuses atoms that no file should hold; writer is the public function's name, for the message.
///
/// @throws InvalidNetwork if a coordinate is not finite, or species are not as many as positions.
void check_atoms(std::string_view writer, const potentials::Atoms& atoms);

[[nodiscard]] bool has_hydrogen(const potentials::Atoms& atoms);

/// The atoms' own box, or a padded one for a cluster without. Where it is not periodic it is made
/// longer if atoms lie outside, as they may after relaxation: LAMMPS refuses to lose atoms.
[[nodiscard]] potentials::Box box_to_write(const potentials::Atoms& atoms);

}  // namespace trivalent::dual
