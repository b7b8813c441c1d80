#pragma once

#include <Eigen/Core>

#include "trivalent/dual/bonding.h"
#include "trivalent/dual/structure.h"

namespace testing_support {

/// Two atoms of graphene, bonded to three images of each other.
inline trivalent::dual::Structure graphene() {
  trivalent::dual::Structure cell;
  cell.atoms.positions = {{0, 0, 8}, {0, 1.42, 8}};
  cell.atoms.species = {trivalent::potentials::Species::carbon,
                        trivalent::potentials::Species::carbon};
  cell.atoms.box.cell.col(0) = Eigen::Vector3d(2.46, 0, 0);
  cell.atoms.box.cell.col(1) = Eigen::Vector3d(-1.23, 2.13, 0);
  cell.atoms.box.cell.col(2) = Eigen::Vector3d(0, 0, 16);
  cell.atoms.box.periodic = {true, true, true};
  cell.bonds = trivalent::dual::find_bonds(cell.atoms);
  return cell;
}

/// H-C-C-H with the hydrogens first and last, in a turned cell that is left-handed.
inline trivalent::dual::Structure acetylene() {
  trivalent::dual::Structure cell;
  cell.atoms.positions = {{0, 0, 0}, {1.06, 0, 0}, {2.26, 0, 0}, {3.32, 0, 0}};
  using enum trivalent::potentials::Species;
  cell.atoms.species = {hydrogen, carbon, carbon, hydrogen};
  cell.atoms.box.cell << 0, 0, 9, 0, 8, 1, -9, 0, 1;
  cell.atoms.box.cell.col(1) *= -1.0;
  cell.atoms.box.origin = {1.0, 2.0, 3.0};
  cell.atoms.box.periodic = {true, true, true};
  cell.bonds = trivalent::dual::find_bonds(cell.atoms);
  return cell;
}

}  // namespace testing_support
