#pragma once

#include <string_view>

#include "trivalent/dual/ideal_structures.h"

namespace trivalent::dual {

/// Beside a structure in directions that are not periodic [Å].
inline constexpr double vacuum = 20.0;

/// @throws InvalidOption naming the structure, if there were more than 10 million atoms.
void require_few_atoms(std::string_view structure, double n_atoms);

/// Cuts the bonds across the cell and closes the edges that result, unless they are to stay
/// periodic. There is no box then.
///
/// @throws InvalidOption if no atom with two bonds is left.
void close_edges(Structure& structure, Edges edges);

}  // namespace trivalent::dual
