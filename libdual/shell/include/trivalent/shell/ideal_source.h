#pragma once

#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::shell {

/// The ideal structures that can be named in place of a file of atoms, as in "nanotube:n=10,m=5":
/// nanotube, graphene, fullerene and onion.
[[nodiscard]] const std::vector<remesh::ShapeDescription>& ideal_structures();

/// Whether the text, up to its first colon, is the name of one.
[[nodiscard]] bool is_ideal_structure(std::string_view text);

/// Makes the structure that the text names; omitted parameters take their defaults.
///
/// @throws remesh::InvalidOption if a parameter is unknown or no whole number.
/// @throws dual::InvalidOption   if a number is out of its range.
[[nodiscard]] dual::Structure make_ideal_structure(std::string_view text);

}  // namespace trivalent::shell
