#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::testing_support {

/// Expects forces = -dE/dx by central differences of fourth order, atom by atom.
///
/// @param tolerance  relative to 1 eV/Å + the largest force
template <typename Potential>
void expect_forces_match_energy(const potentials::Atoms& atoms, const Potential& potential,
                                double tolerance) {
  const potentials::EnergyForces result = potential(atoms);
  double largest = 0.0;
  for (const auto& f : result.forces) largest = std::max(largest, f.norm());
  // Errors: truncation ~ h^4 against rounding ~ 1e-16 |E| / h.
  constexpr double step = 4e-5;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto energy_at = [&](double shift) {
        potentials::Atoms moved = atoms;
        moved.positions[i][k] += shift;
        return potential(moved).energy;
      };
      const double slope = (8.0 * (energy_at(step) - energy_at(-step)) -
                            (energy_at(2.0 * step) - energy_at(-2.0 * step))) /
                           (12.0 * step);
      EXPECT_NEAR(result.forces[i][k], -slope, tolerance * (1.0 + largest))
          << "atom " << i << " along " << k;
    }
  }
}

/// Expects virial = -dE/dε for all nine components of the strain of positions and cell.
template <typename Potential>
void expect_virial_matches_energy(const potentials::Atoms& atoms, const Potential& potential,
                                  double tolerance) {
  const potentials::EnergyForces result = potential(atoms);
  constexpr double step = 1e-5;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const auto energy_at = [&](double strain) {
        Eigen::Matrix3d deformation = Eigen::Matrix3d::Identity();
        deformation(row, column) += strain;
        potentials::Atoms strained = atoms;
        for (Eigen::Vector3d& x : strained.positions) x = (deformation * x).eval();
        strained.box.cell = deformation * atoms.box.cell;
        return potential(strained).energy;
      };
      const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
      EXPECT_NEAR(result.virial(row, column), -slope,
                  tolerance * (1.0 + result.virial.cwiseAbs().maxCoeff()))
          << row << column;
    }
  }
}

/// Expects that the forces add up to nothing.
inline void expect_no_net_force(const potentials::EnergyForces& result) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double scale = 1.0;
  for (const auto& f : result.forces) {
    sum += f;
    scale += f.norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * scale);  // rounding of a sum of that size
}

/// Expects that the energies of the atoms add up to the total.
inline void expect_energies_add_up(const potentials::EnergyForces& result) {
  double sum = 0.0;
  double scale = 1.0;
  for (const double e : result.energies) {
    sum += e;
    scale += std::abs(e);
  }
  EXPECT_NEAR(sum, result.energy, 1e-13 * scale);
}

}  // namespace trivalent::testing_support
