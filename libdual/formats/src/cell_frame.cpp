#include "cell_frame.h"

#include <Eigen/LU>

#include "trivalent/dual/error.h"
#include "trivalent/dual/padded_box.h"
#include "trivalent/formats/lammps_frame.h"

namespace trivalent::dual {
namespace {

using potentials::Box;

void note_free_directions(const Box& box, std::vector<std::string>& notes) {
  if (box.periodic[0] && box.periodic[1] && box.periodic[2]) return;
  if (!box.is_periodic()) {
    notes.emplace_back("the format knows no free atoms: they are in a periodic cell with room");
    return;
  }
  std::string names;
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.periodic[i]) continue;
    names += names.empty() ? "" : " and ";
    names += "abc"[i];
  }
  notes.push_back("the format knows no free directions: " + names + " became periodic");
}

/// The box of the atoms; where a free direction has no vector, one with room stands in.
Box complete_box(const potentials::Atoms& atoms) {
  for (std::size_t k = 0; k < 3; ++k) {
    const bool is_missing = atoms.box.cell.col(static_cast<Eigen::Index>(k)).isZero(0.0);
    if (is_missing && atoms.box.is_periodic() && !atoms.box.periodic[k]) {
      return periodic_box(atoms.box, atoms.positions);
    }
  }
  return box_to_write(atoms);
}

CellFrame general_frame(const potentials::Atoms& atoms) {
  const Box box = complete_box(atoms);
  CellFrame frame = {.positions = atoms.positions, .cell = box.cell, .notes = {}};
  const double volume = box.cell.determinant();
  if (volume == 0.0) {
    throw InvalidOption("the cell vectors lie in a plane or on a line: no cell can be written");
  }
  if (volume < 0.0) {
    frame.cell.col(2) *= -1.0;
    frame.notes.emplace_back("c was replaced by its opposite, so that the cell is right-handed");
  }
  for (Eigen::Vector3d& x : frame.positions) x -= box.origin;
  return frame;
}

CellFrame triangular_frame(const potentials::Atoms& atoms) {
  LammpsFrame there = lammps_frame(atoms);
  CellFrame frame = {
      .positions = std::move(there.atoms.positions), .cell = there.atoms.box.cell, .notes = {}};
  for (Eigen::Vector3d& x : frame.positions) x -= there.atoms.box.origin;
  if (there.is_rotated()) {
    frame.notes.emplace_back("the atoms were rotated: a is along x, b in the xy plane");
  }
  if (!there.combination.isIdentity(0.0)) {
    frame.notes.emplace_back("the cell vectors were replaced by equivalent ones");
  }
  return frame;
}

}  // namespace

CellFrame cell_frame(const potentials::Atoms& atoms, CellKind kind) {
  CellFrame frame = kind == CellKind::general ? general_frame(atoms) : triangular_frame(atoms);
  if (!atoms.box.origin.isZero(0.0) && atoms.box.is_periodic()) {
    frame.notes.emplace_back("positions are counted from the corner of the box");
  }
  note_free_directions(atoms.box, frame.notes);
  return frame;
}

}  // namespace trivalent::dual
