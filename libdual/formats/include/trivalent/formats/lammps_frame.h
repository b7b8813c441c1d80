#pragma once

#include <Eigen/Core>

#include "trivalent/dual/error.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Whether LAMMPS takes a box: cell vectors a along x, b in the xy plane, right-handed, tilts of at
/// most half a side and only of periodic vectors.
[[nodiscard]] bool fits_lammps(const potentials::Box& box);

/// Atoms in a box that LAMMPS takes, and the way back.
///
/// The periodic cell vectors are rotated with the atoms, and replaced by equivalent ones: sums of
/// whole vectors (tilts), the opposite of one (left-handed cells). Where the box is not periodic it
/// is replaced by a padded one at right angles. Energies stay as they are.
struct LammpsFrame {
  potentials::Atoms atoms;
  /// Rotation to LAMMPS's frame: x there = rotation · x here.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  /// Periodic cell vectors there = rotation · cell here · combination.
  Eigen::Matrix3d combination = Eigen::Matrix3d::Identity();

  [[nodiscard]] bool is_rotated() const { return !rotation.isIdentity(0.0); }
  /// A position, force or displacement of LAMMPS's frame in the frame of the atoms that were given.
  [[nodiscard]] Eigen::Vector3d back(const Eigen::Vector3d& vector) const {
    return rotation.transpose() * vector;
  }
  /// A box of LAMMPS's frame likewise; `before` is the one that was given, and stays where it is
  /// not periodic.
  [[nodiscard]] potentials::Box back(const potentials::Box& box,
                                     const potentials::Box& before) const;
};

/// The atoms with a box that LAMMPS takes; unchanged if it takes theirs.
///
/// @throws InvalidOption if periodic cell vectors are zero, not finite, or lie in one plane or
/// line.
[[nodiscard]] LammpsFrame lammps_frame(const potentials::Atoms& atoms);

}  // namespace trivalent::dual
