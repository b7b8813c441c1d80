// Energy and forces of a sheet of graphene by REBO, and of the same sheet with one atom pushed out.

#include <cmath>
#include <cstdio>

#include "trivalent/potentials/rebo.h"

using trivalent::potentials::Atoms;
using trivalent::potentials::Rebo;
using trivalent::potentials::Species;

// Periodic, of 4 × 4 rectangular cells of four atoms; bond lengths in Å.
Atoms graphene(double bond) {
  const double width = std::sqrt(3.0) * bond;
  const double height = 3.0 * bond;
  Atoms atoms;
  for (int cell = 0; cell < 16; ++cell) {
    const Eigen::Vector3d corner(cell % 4 * width, cell / 4 * height, 10.0);
    atoms.positions.push_back(corner);
    atoms.positions.push_back(corner + Eigen::Vector3d(0.5 * width, 0.5 * bond, 0.0));
    atoms.positions.push_back(corner + Eigen::Vector3d(0.5 * width, 1.5 * bond, 0.0));
    atoms.positions.push_back(corner + Eigen::Vector3d(0.0, 2.0 * bond, 0.0));
  }
  atoms.species.assign(atoms.positions.size(), Species::carbon);
  atoms.box.cell = Eigen::Vector3d(4 * width, 4 * height, 20.0).asDiagonal();
  atoms.box.periodic = {true, true, true};
  return atoms;
}

int main() {
  Atoms atoms = graphene(1.42039);
  Rebo potential;  // keeps neighbors from one evaluation to the next
  const double flat = potential.evaluate(atoms).energy;
  std::printf("graphene: %.5f eV per atom\n", flat / static_cast<double>(atoms.size()));

  atoms.positions[21].z() += 0.1;
  const auto& result = potential.evaluate(atoms);
  std::printf("an atom 0.1 Å out of the plane costs %.4f eV and is pulled back by %.3f eV/Å\n",
              result.energy - flat, -result.forces[21].z());
}
