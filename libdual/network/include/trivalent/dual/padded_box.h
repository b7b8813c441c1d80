#pragma once

#include <Eigen/Core>
#include <span>

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Free space left around a cluster in file formats that want a box [Å]. LAMMPS loses atoms that
/// sit on a fixed box face, and a periodic copy then stays out of reach of the potentials.
inline constexpr double default_padding = 10.0;

/// The bounding box of the positions with padding [Å] on all sides, periodic in no direction.
[[nodiscard]] potentials::Box padded_box(std::span<const Eigen::Vector3d> positions,
                                         double padding = default_padding);

/// A box with the periodic vectors of another. The other vectors stand at right angles on them and
/// on each other, and leave padding [Å] on both sides of the positions.
[[nodiscard]] potentials::Box periodic_box(potentials::Box box,
                                           std::span<const Eigen::Vector3d> positions,
                                           double padding = default_padding);

/// The atoms' own box, or a padded one for a cluster without. Where it is not periodic it is made
/// longer if atoms lie outside, as they may after relaxation: LAMMPS refuses to lose atoms.
[[nodiscard]] potentials::Box box_to_write(const potentials::Atoms& atoms);

}  // namespace trivalent::dual
