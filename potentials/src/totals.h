#pragma once

#include <Eigen/Core>

#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials {

/// What adds up over all atoms.
struct Totals {
  double energy = 0.0;                               ///< [eV]
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();  ///< [eV]

  Totals& operator+=(const Totals& other) {
    energy += other.energy;
    virial += other.virial;
    return *this;
  }
};

/// A result for n atoms, all zero.
[[nodiscard]] inline EnergyForces zero_energy_forces(std::size_t n) {
  EnergyForces result;
  result.energies.assign(n, 0.0);
  result.forces.assign(n, Eigen::Vector3d::Zero());
  return result;
}

}  // namespace trivalent::potentials
