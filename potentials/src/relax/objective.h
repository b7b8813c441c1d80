#pragma once

#include "relax/bond_guard.h"
#include "relax/descent.h"
#include "relax/vectors.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// A point in the space of all coordinates that are relaxed.
struct Point {
  Vector coordinates;   ///< three per atom; then nine of the cell, if it is relaxed [Å]
  double energy = 0.0;  ///< [eV]
  Vector gradient;      ///< of the energy [eV/Å]; zero for what is fixed
};

/// Energy and gradient of all that acts in a descent, over the coordinates. Fixed atoms and a cell
/// that is relaxed are handled here; minimizers need not know about either.
class Objective {
 public:
  Objective(Atoms atoms, const DescentOptions& descent, std::span<const std::uint32_t> fixed);

  /// Where the atoms are at the beginning.
  [[nodiscard]] Point start() const;

  /// Sets energy and gradient from the coordinates. Returns false, and no values, where a bond
  /// would tear or there is no finite energy.
  [[nodiscard]] bool evaluate(Point& point);

  /// The atoms of the last evaluation.
  [[nodiscard]] const Atoms& atoms() const { return atoms_; }
  /// Of the potential alone, in the last evaluation.
  [[nodiscard]] const EnergyForces& result() const { return result_; }
  /// Likewise, on an atom that is not fixed [eV/Å].
  [[nodiscard]] double largest_force() const;
  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// Lets the bonds be as long as they are now, where they exceed the limit.
  void accept() { guard_.accept(atoms_); }

  [[nodiscard]] Atoms take_atoms() { return std::move(atoms_); }
  [[nodiscard]] EnergyForces take_result() { return std::move(result_); }

 private:
  void place_atoms(const Vector& coordinates);
  [[nodiscard]] Eigen::Vector3d force(std::size_t atom) const;
  void set_gradient(Vector& gradient) const;

  Atoms atoms_;
  Potential* potential_;
  NetworkSprings* springs_;
  BondGuard guard_;
  std::vector<bool> is_fixed_;  // per atom
  EnergyForces result_;         // of the potential
  EnergyForces spring_forces_;
  int evaluations_ = 0;
  bool has_cell_;
  Eigen::Matrix3d first_cell_;
  Eigen::Matrix3d free_directions_;  // projects onto the span of the periodic cell vectors
  Eigen::Matrix3d deformation_ = Eigen::Matrix3d::Identity();
  double cell_length_;  // [Å] that the cell's coordinates change by at a strain of 1
};

}  // namespace trivalent::potentials::relax_detail
