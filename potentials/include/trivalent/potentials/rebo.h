#pragma once

#include <memory>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/potentials/potential.h"

namespace trivalent::potentials {

namespace rebo_detail {
class Evaluator;
}

/// How REBO is evaluated; nothing here changes the energy.
struct ReboOptions {
  double skin = 0.3;  ///< [Å], >= 0: neighbors are searched again once an atom moved half of it
};

/// Energy and forces of carbon and hydrogen by the second-generation REBO potential [Brenner2002],
/// with the values LAMMPS `pair_style rebo` uses [LAMMPS].
///
/// Each atom gets half of the energy of each of its bonds. Boxes may be periodic in any direction,
/// orthogonal or triclinic, and smaller than the cutoff (2 Å): images count as atoms of their own.
///
/// @throws InvalidAtoms   see NeighborList; also if two atoms coincide.
/// @throws InvalidOption  if an option is out of its range.
///
/// Cost: O(n) time and memory; the same bytes on any number of threads.
[[nodiscard]] EnergyForces rebo(const AtomsView& atoms, const ReboOptions& options = {});

/// The same potential for atoms that move: neighbors are kept from one evaluation to the next for
/// as long as no atom has moved by more than half the skin.
class Rebo : public Potential {
 public:
  /// @throws InvalidOption  if an option is out of its range.
  explicit Rebo(const ReboOptions& options = {});
  Rebo(const Rebo&) = delete;
  Rebo& operator=(const Rebo&) = delete;
  ~Rebo() override;

  void forget() override;

 private:
  /// @throws InvalidAtoms  as rebo() does.
  void compute(const AtomsView& atoms, EnergyForces& result) override;

  std::unique_ptr<rebo_detail::Evaluator> evaluator_;
};

}  // namespace trivalent::potentials
