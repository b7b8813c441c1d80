#pragma once

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/potentials/potential.h"

namespace trivalent::potentials {

/// Parameters of the Lennard-Jones potential; the defaults are carbon's, as AIREBO has them
/// [Stuart2000, Table 2] rounded to the digits in common use. Species make no difference.
struct LennardJonesOptions {
  double epsilon = 0.00284;  ///< depth of the well [eV], finite
  double sigma = 3.4;        ///< distance at which the energy crosses zero [Å], > 0
  double cutoff = 10.2;      ///< pairs farther apart do not interact [Å], > 0
  bool shift = false;        ///< subtract the energy at the cutoff, so that it is continuous there
};

/// Lennard-Jones energy 4ε[(σ/r)^12 - (σ/r)^6] of all pairs within the cutoff, with forces.
///
/// No pair is excluded, bonded or not; in a periodic box an atom also meets its own images.
/// Each atom gets half of the energy of each of its pairs.
///
/// @throws InvalidAtoms   see NeighborList; also if two atoms coincide.
/// @throws InvalidOption  if an option is out of its range.
///
/// Cost: O(n · pairs per atom) time, O(n) memory; the same bytes on any number of threads.
[[nodiscard]] EnergyForces lennard_jones(const AtomsView& atoms,
                                         const LennardJonesOptions& options = {});

/// lennard_jones() as an object. Nothing is kept between evaluations.
class LennardJones : public Potential {
 public:
  /// @throws InvalidOption  if an option is out of its range.
  explicit LennardJones(const LennardJonesOptions& options = {});

 private:
  void compute(const AtomsView& atoms, EnergyForces& result) override;

  LennardJonesOptions options_;
};

}  // namespace trivalent::potentials
