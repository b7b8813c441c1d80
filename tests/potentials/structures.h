#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <utility>

#include "random_atoms.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::testing_support {

/// Periodic graphene of nx × ny rectangular cells of four atoms, flat at z = 0 [Å].
[[nodiscard]] inline potentials::Atoms graphene(int nx, int ny, double bond) {
  const double width = std::sqrt(3.0) * bond;
  const double height = 3.0 * bond;
  potentials::Atoms atoms;
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      const Eigen::Vector3d corner(x * width, y * height, 0.0);
      for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.5, 1.5}, {0.0, 2.0}}) {
        atoms.positions.emplace_back(corner + Eigen::Vector3d(u * width, v * bond, 0.0));
      }
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  atoms.box.cell = Eigen::Vector3d(nx * width, ny * height, 20.0).asDiagonal();
  atoms.box.periodic = {true, true, false};
  return atoms;
}

/// Periodic diamond of n³ cubic cells of eight atoms [Å].
[[nodiscard]] inline potentials::Atoms diamond(int n, double lattice) {
  potentials::Atoms atoms;
  for (int cell = 0; cell < n * n * n; ++cell) {
    const Eigen::Vector3d corner(cell % n, cell / n % n, cell / n / n);
    for (const Eigen::Vector3d& face :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0.5, 0.5), Eigen::Vector3d(0.5, 0, 0.5),
          Eigen::Vector3d(0.5, 0.5, 0)}) {
      atoms.positions.emplace_back(lattice * (corner + face));
      atoms.positions.emplace_back(lattice * (corner + face + Eigen::Vector3d::Constant(0.25)));
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  atoms.box = periodic(cube(n * lattice));
  return atoms;
}

/// Ethane-like: two carbons and six hydrogens, none of them at rest [Å].
[[nodiscard]] inline potentials::Atoms bent_ethane() {
  potentials::Atoms atoms;
  atoms.positions = {{0.00, 0.02, -0.76},  {0.03, 0.00, 0.77},  {1.05, 0.01, 1.16},
                     {-0.50, -0.93, 1.15}, {-0.52, 0.87, 1.14}, {0.51, 0.90, -1.18},
                     {0.55, -0.86, -1.16}, {-1.02, 0.00, -1.12}};
  atoms.species.assign(8, potentials::Species::hydrogen);
  atoms.species[0] = atoms.species[1] = potentials::Species::carbon;
  return atoms;
}

/// Carbon and hydrogen at random, no two nearer than `apart` [Å].
[[nodiscard]] inline potentials::Atoms random_hydrocarbon(std::size_t count,
                                                          const potentials::Box& box, double apart,
                                                          unsigned seed) {
  std::mt19937 generator(seed);
  potentials::Atoms atoms;
  atoms.box = box;
  for (unsigned attempt = 0; atoms.size() < count && attempt < 100000; ++attempt) {
    const Eigen::Vector3d x = random_gas(1, box, static_cast<unsigned>(generator())).positions[0];
    bool is_free = true;
    for (const Eigen::Vector3d& other : atoms.positions) {
      Eigen::Vector3d between = box.cell.inverse() * (x - other);
      if (box.is_periodic()) between -= between.array().round().matrix();
      is_free = is_free && (box.cell * between).norm() > apart;
    }
    if (!is_free) continue;
    atoms.positions.push_back(x);
    atoms.species.push_back(generator() % 3 == 0 ? potentials::Species::hydrogen
                                                 : potentials::Species::carbon);
  }
  return atoms;
}

}  // namespace trivalent::testing_support
