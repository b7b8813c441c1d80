#pragma once

#include "relax/bond_guard.h"
#include "relax/vectors.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// A place in the space of all coordinates that are relaxed.
struct Point {
  Vector coordinates;   ///< three per atom; then nine of the cell, if it is relaxed [Å]
  double energy = 0.0;  ///< [eV]
  Vector gradient;      ///< of the energy [eV/Å]; zero for what is fixed
};

/// Energy and gradient over the coordinates: atoms that are fixed and a cell that is relaxed are
/// seen to here, and minimizers need not know about either.
class Objective {
 public:
  Objective(Atoms atoms, Potential& potential, const RelaxOptions& options);

  /// Where the atoms are at the beginning.
  [[nodiscard]] Point start();

  /// Sets energy and gradient from the coordinates. Returns false, and no values, where a bond
  /// would tear or there is no finite energy.
  [[nodiscard]] bool evaluate(Point& point);

  /// The atoms of the last evaluation.
  [[nodiscard]] const Atoms& atoms() const { return atoms_; }
  [[nodiscard]] const EnergyForces& result() const { return result_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// Lets the bonds be as long as they are now, where they exceed the limit.
  void accept() { guard_.accept(atoms_); }

 private:
  void place_atoms(const Vector& coordinates);
  void set_gradient(Vector& gradient) const;

  Atoms atoms_;
  Potential& potential_;
  BondGuard guard_;
  std::vector<std::uint32_t> fixed_;
  EnergyForces result_;
  int evaluations_ = 0;
  bool has_cell_;
  Eigen::Matrix3d first_cell_;
  Eigen::Matrix3d free_directions_;  // projects onto the span of the periodic cell vectors
  Eigen::Matrix3d deformation_ = Eigen::Matrix3d::Identity();
  double cell_length_;  // [Å] that the cell's coordinates change by at a strain of 1
};

}  // namespace trivalent::potentials::relax_detail
