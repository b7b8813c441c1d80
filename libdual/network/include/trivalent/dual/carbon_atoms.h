#pragma once

#include <Eigen/Core>
#include <span>

#include "trivalent/dual/network.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Free space left around a cluster in file formats that want a box [Å]. LAMMPS loses atoms that
/// sit on a fixed box face, and a periodic copy then stays out of reach of the potentials.
inline constexpr double default_padding = 10.0;

/// The bounding box of the positions with padding [Å] on all sides, periodic in no direction.
[[nodiscard]] potentials::Box padded_box(std::span<const Eigen::Vector3d> positions,
                                         double padding = default_padding);

/// The network's atoms (carbon, and hydrogen where it was capped) in free space, with a padded box;
/// bonds and rings stay behind.
[[nodiscard]] potentials::Atoms carbon_atoms(const Network& network);

}  // namespace trivalent::dual
