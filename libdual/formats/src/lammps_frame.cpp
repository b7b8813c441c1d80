#include "trivalent/formats/lammps_frame.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "trivalent/dual/padded_box.h"

namespace trivalent::dual {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using potentials::Atoms;
using potentials::Box;

bool is_periodic(const Box& box, int axis) { return box.periodic[static_cast<std::size_t>(axis)]; }

/// What is left of a vector at right angles to the given columns of a matrix, which are at right
/// angles to each other only if they are units; zero if that is next to nothing.
Vector3d rest_of(const Vector3d& vector, const Matrix3d& units) {
  Vector3d rest = vector;
  for (int i = 0; i < 3; ++i) rest -= units.col(i).dot(rest) * units.col(i);
  return rest.norm() > 1e-6 * vector.norm() ? rest.normalized() : Vector3d::Zero();
}

/// Puts unit vectors at right angles to the periodic cell vectors in the place of the others.
Matrix3d with_right_angles(const Box& box) {
  Matrix3d units = Matrix3d::Zero();  // that span the periodic directions, then all
  for (int i = 0; i < 3; ++i) {
    if (!is_periodic(box, i)) continue;
    units.col(i) = rest_of(box.cell.col(i), units);
    if (units.col(i).isZero() || !box.cell.col(i).allFinite()) {
      throw InvalidOption(concat("lammps_frame: periodic cell vector ", i + 1,
                                 " is zero or lies in the plane or line of others"));
    }
  }
  Matrix3d cell = box.cell;
  for (int i = 0; i < 3; ++i) {
    if (is_periodic(box, i)) continue;
    // As near to the vector that was given, or to the axis, as can be.
    Vector3d unit = rest_of(box.cell.col(i), units);
    for (int axis = i; unit.isZero() && axis < i + 3; ++axis) {
      unit = rest_of(Vector3d::Unit(axis % 3), units);
    }
    units.col(i) = unit;
    cell.col(i) = unit;
  }
  return cell;
}

/// Turns the last vector round if the cell is left-handed; one that is not periodic if there is
/// one.
void make_right_handed(const Box& box, Matrix3d& cell, Matrix3d& combination) {
  if (cell.determinant() > 0.0) return;
  int turned = 2;
  for (int i = 0; i < 3; ++i) {
    if (!is_periodic(box, i)) turned = i;
  }
  cell.col(turned) *= -1.0;
  combination.col(turned) *= -1.0;
}

/// Takes whole vectors off others until no tilt is more than half a side.
void reduce_tilts(const Box& box, Matrix3d& cell, Matrix3d& combination) {
  const auto reduce = [&](int tilted, int side) {
    if (!is_periodic(box, tilted) || !is_periodic(box, side)) return;
    const double n = std::round(cell(side, tilted) / cell(side, side));
    cell.col(tilted) -= n * cell.col(side);
    combination.col(tilted) -= n * combination.col(side);
  };
  reduce(1, 0);
  reduce(2, 1);
  reduce(2, 0);
}

/// Pads the box around the atoms where it is not periodic, along the axes.
void pad(Atoms& atoms) {
  const Box padded = padded_box(atoms.positions);
  Box& box = atoms.box;
  for (int i = 0; i < 3; ++i) {
    if (is_periodic(box, i)) continue;
    box.origin[i] = padded.origin[i];
    box.cell.col(i) = padded.cell.col(i);
    box.cell.row(i) = padded.cell.row(i);
  }
}

/// What a rotation that is meant to be none leaves below the diagonal.
void drop_rounding_errors(Matrix3d& cell) {
  constexpr double relative = 1e-13;
  const double scale = cell.norm();
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (row != column && std::abs(cell(row, column)) < relative * scale) cell(row, column) = 0.0;
    }
  }
}

}  // namespace

bool fits_lammps(const Box& box) {
  const Matrix3d& cell = box.cell;
  const bool is_finite = cell.allFinite() && box.origin.allFinite();
  const bool is_upper_triangular = cell(1, 0) == 0.0 && cell(2, 0) == 0.0 && cell(2, 1) == 0.0;
  if (!is_finite || !is_upper_triangular || cell.diagonal().minCoeff() <= 0.0) return false;
  const auto fits = [&](int tilted, int side) {
    const double tilt = std::abs(cell(side, tilted));
    return tilt == 0.0 || (is_periodic(box, tilted) && tilt <= 0.5 * cell(side, side));
  };
  return fits(1, 0) && fits(2, 0) && fits(2, 1);
}

LammpsFrame lammps_frame(const Atoms& atoms) {
  LammpsFrame frame = {.atoms = atoms};
  Box& box = frame.atoms.box;
  box = box_to_write(atoms);
  drop_rounding_errors(box.cell);
  if (fits_lammps(box)) return frame;
  if (!box.is_periodic()) {
    box = padded_box(atoms.positions);
    return frame;
  }
  Matrix3d cell = with_right_angles(box);
  make_right_handed(box, cell, frame.combination);
  const Eigen::HouseholderQR<Matrix3d> decomposition(cell);
  Matrix3d axes = decomposition.householderQ();  // of LAMMPS's frame, as columns
  for (int i = 0; i < 3; ++i) {
    if (axes.col(i).dot(cell.col(i)) < 0.0) axes.col(i) *= -1.0;
  }
  if (axes.isIdentity(1e-13)) axes.setIdentity();
  frame.rotation = axes.transpose();
  box.cell = (frame.rotation * cell).triangularView<Eigen::Upper>();
  drop_rounding_errors(box.cell);
  reduce_tilts(box, box.cell, frame.combination);
  box.origin = frame.rotation * atoms.box.origin;
  for (Vector3d& x : frame.atoms.positions) x = frame.rotation * x;
  pad(frame.atoms);
  return frame;
}

Box LammpsFrame::back(const Box& box, const Box& before) const {
  Box result = before;
  const Matrix3d cell = rotation.transpose() * box.cell * combination.inverse();
  Vector3d origin = rotation * before.origin;
  for (int i = 0; i < 3; ++i) {
    if (!is_periodic(before, i)) continue;
    result.cell.col(i) = cell.col(i);
    origin[i] = box.origin[i];
  }
  result.origin = rotation.transpose() * origin;
  return result;
}

}  // namespace trivalent::dual
