#pragma once

#include <Eigen/Core>
#include <array>

namespace trivalent::dual {

/// Lengths of cell vectors and the angles between them.
struct CellAngles {
  std::array<double, 3> lengths;  ///< a, b, c [Å]
  std::array<double, 3> angles;   ///< α, β, γ [degree]
};

/// Of cell vectors in columns.
[[nodiscard]] CellAngles cell_angles(const Eigen::Matrix3d& cell);

/// Cell vectors in columns: a along x, b in the xy plane. Right angles give exact zeros. Not finite
/// if no cell has such angles.
[[nodiscard]] Eigen::Matrix3d cell_of(const CellAngles& parameters);

}  // namespace trivalent::dual
