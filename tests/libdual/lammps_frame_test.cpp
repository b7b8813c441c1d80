#include "trivalent/formats/lammps_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <random>

#include "trivalent/dual/padded_box.h"
#include "trivalent/potentials/rebo.h"

namespace trivalent::dual {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using potentials::Atoms;

/// Diamond, six cells, slightly disordered: no two directions are alike.
Atoms disordered_diamond() {
  Atoms atoms;
  atoms.box.cell << 0, 1.785, 1.785, 1.785, 0, 1.785, 1.785, 1.785, 0;
  const Matrix3d unit = atoms.box.cell;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 2; ++b) {
      for (const double corner : {0.0, 0.25}) {
        const Vector3d fractions = Vector3d(a, b, 0) + Vector3d::Constant(corner);
        atoms.positions.push_back(unit * fractions +
                                  Vector3d(shift(random), shift(random), shift(random)));
      }
    }
  }
  atoms.box.cell.col(0) *= 3.0;
  atoms.box.cell.col(1) *= 2.0;
  atoms.box.periodic = {true, true, true};
  atoms.species.assign(atoms.size(), potentials::Species::carbon);
  return atoms;
}

/// The same atoms turned, in another cell of the same lattice, with some directions free.
Atoms variant_of(Atoms atoms, std::mt19937& random) {
  std::uniform_int_distribution<int> whole(-2, 2);
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  Matrix3d combination = Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    combination.col(i) += whole(random) * combination.col((i + 1) % 3);
  }
  if (whole(random) > 0) combination.col(0) *= -1.0;
  atoms.box.cell *= combination;
  const Matrix3d turn = Eigen::Quaterniond(real(random), real(random), real(random), real(random))
                            .normalized()
                            .toRotationMatrix();
  atoms.box.cell = turn * atoms.box.cell;
  for (Vector3d& x : atoms.positions) x = turn * x;
  for (int i = 0; i < 3; ++i) {
    if (whole(random) < 1) continue;
    atoms.box.periodic[static_cast<std::size_t>(i)] = false;
    if (whole(random) > 0) atoms.box.cell.col(i).setZero();
  }
  return atoms;
}

TEST(LammpsFrame, KeepsEnergiesAndFitsLammps) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const Atoms atoms = variant_of(disordered_diamond(), random);
    const LammpsFrame frame = lammps_frame(atoms);
    EXPECT_TRUE(fits_lammps(frame.atoms.box)) << frame.atoms.box.cell;
    EXPECT_EQ(frame.atoms.box.periodic, atoms.box.periodic);
    const auto here = potentials::rebo(atoms);
    const auto there = potentials::rebo(frame.atoms);
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      EXPECT_NEAR(there.energies[i], here.energies[i], 1e-10);
      EXPECT_LT((frame.back(there.forces[i]) - here.forces[i]).norm(), 1e-9);
      EXPECT_LT((frame.back(frame.atoms.positions[i]) - atoms.positions[i]).norm(), 1e-12);
    }
  }
}

TEST(LammpsFrame, LeadsTheBoxBack) {
  std::mt19937 random(2);
  for (int round = 0; round < 60; ++round) {
    const Atoms atoms = variant_of(disordered_diamond(), random);
    const LammpsFrame frame = lammps_frame(atoms);
    const potentials::Box back = frame.back(frame.atoms.box, atoms.box);
    EXPECT_LT((back.cell - atoms.box.cell).norm(), 1e-11);
    EXPECT_LT((back.origin - atoms.box.origin).norm(), 1e-11);
    EXPECT_EQ(back.periodic, atoms.box.periodic);
  }
}

TEST(LammpsFrame, HasRoomAroundAtomsWhereItIsFree) {
  std::mt19937 random(3);
  for (int round = 0; round < 30; ++round) {
    const Atoms atoms = variant_of(disordered_diamond(), random);
    const LammpsFrame frame = lammps_frame(atoms);
    const potentials::Box& box = frame.atoms.box;
    for (const Vector3d& x : frame.atoms.positions) {
      for (int i = 0; i < 3; ++i) {
        if (box.periodic[static_cast<std::size_t>(i)]) continue;
        EXPECT_GT(x[i], box.origin[i]);
        EXPECT_LT(x[i], box.origin[i] + box.cell(i, i));
      }
    }
  }
}

TEST(LammpsFrame, ChangesNothingThatFits) {
  Atoms atoms = disordered_diamond();
  atoms.box.cell << 9, 4.5, -4, 0, 8, 3, 0, 0, 20;
  const LammpsFrame frame = lammps_frame(atoms);
  EXPECT_FALSE(frame.is_rotated());
  EXPECT_EQ(frame.atoms.positions, atoms.positions);
  EXPECT_EQ(frame.atoms.box.cell, atoms.box.cell);
}

TEST(LammpsFrame, TakesNextToNothingAsNothing) {
  Atoms atoms = disordered_diamond();
  atoms.box.cell << 9, 4.5, 0, -3e-20, 8, 0, 1e-19, 0, 20;
  const LammpsFrame frame = lammps_frame(atoms);
  EXPECT_FALSE(frame.is_rotated());
  EXPECT_EQ(frame.atoms.positions, atoms.positions);
  EXPECT_TRUE(fits_lammps(frame.atoms.box));
}

TEST(LammpsFrame, PadsAClusterInsteadOfTurningIt) {
  Atoms atoms = disordered_diamond();
  atoms.box.periodic = {false, false, false};
  const LammpsFrame frame = lammps_frame(atoms);
  EXPECT_FALSE(frame.is_rotated());
  EXPECT_EQ(frame.atoms.positions, atoms.positions);
  EXPECT_EQ(frame.atoms.box.cell, padded_box(atoms.positions).cell);
}

TEST(LammpsFrame, ThrowsOnPeriodicVectorsThatSpanNoBox) {
  for (const Vector3d& second : {Vector3d(0, 0, 0), Vector3d(-4, 0, 0)}) {
    Atoms atoms = disordered_diamond();
    atoms.box.cell.col(0) = Vector3d(9, 0, 0);
    atoms.box.cell.col(1) = second;
    EXPECT_THROW(static_cast<void>(lammps_frame(atoms)), InvalidOption);
  }
}

}  // namespace
}  // namespace trivalent::dual
