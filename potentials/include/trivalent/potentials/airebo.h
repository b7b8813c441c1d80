#pragma once

#include <memory>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/potentials/potential.h"

namespace trivalent::potentials {

/// Which terms of AIREBO are evaluated beside the bonds.
struct AireboOptions {
  bool lennard_jones = true;  ///< between atoms that are not connected by up to three bonds
  bool torsion = true;        ///< about single bonds between carbons
};

/// Energy and forces of carbon and hydrogen by the AIREBO potential [Stuart2000], as LAMMPS
/// `pair_style airebo 3.0 1 1` evaluates it [LAMMPS].
///
/// Its bonds have other parameters than rebo(), above all P_CC(2, 0): graphene is at -7.43 eV per
/// atom. An atom gets half of the energy of each of its bonds and pairs and a quarter of each
/// torsion. Where two paths of stretched bonds screen a pair equally, the energy has a kink; the
/// force is then that of one side.
///
/// @throws InvalidAtoms  see NeighborList; also if two atoms coincide.
///
/// Cost: O(n · pairs within 10.2 Å); the same bytes on any number of threads.
[[nodiscard]] EnergyForces airebo(const AtomsView& atoms, const AireboOptions& options = {});

/// airebo() as an object, which keeps the neighbors of atoms that move little: 10 to 600 pairs an
/// atom of 4 bytes each.
class Airebo : public Potential {
 public:
  explicit Airebo(const AireboOptions& options = {});
  Airebo(const Airebo&) = delete;
  Airebo& operator=(const Airebo&) = delete;
  ~Airebo() override;

  void forget() override;

 private:
  struct State;

  void compute(const AtomsView& atoms, EnergyForces& result) override;

  AireboOptions options_;
  std::unique_ptr<State> state_;
};

}  // namespace trivalent::potentials
