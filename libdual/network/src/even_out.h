#pragma once

#include <functional>

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// Lets the bonds pull the atoms along a surface towards the length of a bond in graphene: where
/// the faces of a polyhedron are projected on a surface, those at its pentagons come out too small,
/// until atoms that have no bond are within reach of each other.
///
/// @param project  Takes a position to the surface's nearest point.
void even_out(Structure& structure,
              const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& project);

}  // namespace trivalent::dual
