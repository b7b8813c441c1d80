#pragma once

#include <random>

#include "trivalent/potentials/atoms.h"

namespace trivalent::testing_support {

/// A cubic frame of the given width around the origin's upper corner, not periodic.
[[nodiscard]] inline potentials::Box cube(double width) {
  potentials::Box box;
  box.cell = width * Eigen::Matrix3d::Identity();
  return box;
}

/// The same box, periodic along all three cell vectors.
[[nodiscard]] inline potentials::Box periodic(potentials::Box box) {
  box.periodic = {true, true, true};
  return box;
}

/// Independent uniform positions in the box, all carbon.
[[nodiscard]] inline potentials::Atoms random_gas(std::size_t count, const potentials::Box& box,
                                                  unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform;
  potentials::Atoms atoms;
  atoms.box = box;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d reduced(uniform(generator), uniform(generator), uniform(generator));
    atoms.positions.emplace_back(box.origin + box.cell * reduced);
    atoms.species.push_back(potentials::Species::carbon);
  }
  return atoms;
}

/// Moves every coordinate by a normally distributed amount [Å].
inline void displace(potentials::Atoms& atoms, double standard_deviation, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, standard_deviation);
  for (Eigen::Vector3d& x : atoms.positions) {
    x += Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
  }
}

}  // namespace trivalent::testing_support
