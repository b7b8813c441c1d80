#pragma once

#include <string_view>

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Refuses atoms that no file should hold; writer is the public function's name, for the message.
///
/// @throws InvalidNetwork if a coordinate is not finite, or species are not as many as positions.
void check_atoms(std::string_view writer, const potentials::Atoms& atoms);

[[nodiscard]] bool has_hydrogen(const potentials::Atoms& atoms);

}  // namespace trivalent::dual
