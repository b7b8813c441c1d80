#include "trivalent/dual/graphene.h"

#include <cmath>

namespace trivalent::dual {

potentials::Atoms graphene_cell(double bond) {
  const double width = std::sqrt(3.0) * bond;
  potentials::Atoms atoms;
  atoms.positions = {{0.0, 0.0, 0.0},
                     {0.0, bond, 0.0},
                     {0.5 * width, 1.5 * bond, 0.0},
                     {0.5 * width, 2.5 * bond, 0.0}};
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  atoms.box.cell.diagonal() = Eigen::Vector3d(width, 3.0 * bond, 20.0);
  atoms.box.periodic = {true, true, false};
  return atoms;
}

}  // namespace trivalent::dual
