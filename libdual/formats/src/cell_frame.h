#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// What cells a format can hold.
enum class CellKind {
  general,    ///< any right-handed cell
  triangular  ///< a along x, b in the xy plane, tilts of at most half a side
};

/// Atoms for formats whose cell has its corner at the origin and is periodic in all directions.
struct CellFrame {
  std::vector<Eigen::Vector3d> positions;  ///< [Å]
  Eigen::Matrix3d cell;                    ///< cell vectors as columns [Å]
  std::vector<std::string> notes;          ///< what had to change, one sentence each
};

/// Free directions get the length of the box, or that of the atoms and some room.
///
/// @throws InvalidOption as lammps_frame().
[[nodiscard]] CellFrame cell_frame(const potentials::Atoms& atoms, CellKind kind);

}  // namespace trivalent::dual
