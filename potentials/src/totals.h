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

/// Makes a result that of n atoms, all zero.
inline void set_zero(EnergyForces& result, std::size_t n) {
  result.energy = 0.0;
  result.energies.assign(n, 0.0);
  result.forces.assign(n, Eigen::Vector3d::Zero());
  result.virial.setZero();
}

}  // namespace trivalent::potentials
