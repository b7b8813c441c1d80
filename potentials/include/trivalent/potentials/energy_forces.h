#pragma once

#include <Eigen/Core>
#include <vector>

namespace trivalent::potentials {

/// Result of every potential.
struct EnergyForces {
  double energy = 0.0;                               ///< total potential energy [eV]
  std::vector<double> energies;                      ///< per atom [eV]; they sum to energy
  std::vector<Eigen::Vector3d> forces;               ///< per atom, -dE/dx [eV/Å]
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();  ///< -dE/dε for strain ε [eV]; > 0 pushes out
};

}  // namespace trivalent::potentials
