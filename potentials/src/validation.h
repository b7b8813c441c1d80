#pragma once

#include <string_view>

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials {

/// Throws InvalidAtoms, with a message that starts with `function`, unless positions and species
/// are as many as each other, finite, countable by 32 bits, and every periodic direction has a
/// cell.
void require_valid(const AtomsView& atoms, std::string_view function);

/// Throws InvalidOption unless `value` is finite and > 0.
void require_positive(double value, std::string_view function, std::string_view option);

/// Throws InvalidAtoms: atoms a and b share one position.
[[noreturn]] void throw_coincident(std::string_view function, std::uint32_t a, std::uint32_t b);

/// The cell with every direction that is not periodic replaced by a unit vector perpendicular to
/// the others [Å]; invertible for valid atoms.
[[nodiscard]] Eigen::Matrix3d completed_cell(const Box& box);

}  // namespace trivalent::potentials
