#pragma once

#include <memory>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"

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
[[nodiscard]] EnergyForces rebo(const Atoms& atoms, const ReboOptions& options = {});

/// The same potential for atoms that move: neighbors are kept from one evaluation to the next for
/// as long as no atom has moved by more than half the skin.
class Rebo {
 public:
  /// @throws InvalidOption  if an option is out of its range.
  explicit Rebo(const ReboOptions& options = {});
  ~Rebo();
  Rebo(Rebo&&) noexcept;
  Rebo& operator=(Rebo&&) noexcept;

  /// Evaluates the atoms. Box, species and number of atoms may change from call to call; neighbors
  /// are then found anew. The result stays valid, and its memory in use, until the next call.
  ///
  /// @throws InvalidAtoms  as rebo() does.
  [[nodiscard]] const EnergyForces& evaluate(const Atoms& atoms);

 private:
  std::unique_ptr<rebo_detail::Evaluator> evaluator_;
};

}  // namespace trivalent::potentials
