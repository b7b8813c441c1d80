#pragma once

#include <variant>

#include "trivalent/dual/build_dual.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::dual {

// The units of a shape mean nothing to atoms; one of these says how large it is.
struct MeanBond {
  double length = default_bond_length;  ///< mean bond length of the dual [Å], > 0
};
struct LongestSide {
  /// Of the longest side of the bounding box, or of the longest periodic cell vector [Å], > 0.
  double length = 0.0;
};
struct Scale {
  double factor = 1.0;  ///< [Å per unit of the mesh], > 0
};

/// Size of the dual of a mesh as it is.
using DualSize = std::variant<MeanBond, LongestSide, Scale>;

/// The factor [Å per unit of the mesh] that gives the mesh, or its dual, the wanted size.
///
/// @throws InvalidOption  if the size is out of its range.
/// @throws InvalidNetwork as build_dual, or if the mesh has no extent or no bonds to measure.
[[nodiscard]] double scale_for_size(const remesh::TriMesh& mesh, const DualSize& size);

}  // namespace trivalent::dual
