#pragma once

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials {

/// A potential energy of atoms and its derivatives.
///
/// An implementation may keep neighbors and memory from one evaluation to the next, so that atoms
/// that move little cost little; an object therefore belongs to one caller at a time.
class Potential {
 public:
  Potential() = default;
  Potential(const Potential&) = delete;
  Potential& operator=(const Potential&) = delete;
  Potential(Potential&&) = delete;
  Potential& operator=(Potential&&) = delete;
  virtual ~Potential() = default;

  /// Energies, forces and virial of the atoms. Box, species and number of atoms may change from
  /// call to call.
  ///
  /// @param memory  A former result; its values are ignored and its memory is reused.
  /// @throws InvalidAtoms  as the implementation says.
  [[nodiscard]] EnergyForces evaluate(const AtomsView& atoms, EnergyForces memory = {}) {
    compute(atoms, memory);
    return memory;
  }

  /// Clears whatever is kept between evaluations. The next one then gives the same bytes as that
  /// of a new object.
  virtual void forget() {}

 private:
  /// Sets all of `result`, whatever it held.
  virtual void compute(const AtomsView& atoms, EnergyForces& result) = 0;
};

}  // namespace trivalent::potentials
