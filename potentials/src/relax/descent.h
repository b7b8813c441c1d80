#pragma once

#include <optional>
#include <span>

#include "relax/bond_laplacian.h"
#include "relax/network_springs.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// What acts in one descent, and when it ends.
struct DescentOptions {
  RelaxStage stage;
  Potential* potential = nullptr;  ///< may be none if there are springs
  NetworkSprings* springs = nullptr;
  Minimizer minimizer = Minimizer::lbfgs;
  double max_move = 0.1;   ///< of an atom in one step [Å]
  double max_force = 0.0;  ///< [eV/Å], of all that acts
  int max_steps = 0;
  std::span<const Bond> guarded = {};  ///< no step tears one of these
  BoxPolicy box = BoxPolicy::fixed;
  const BondLaplacian* preconditioner = nullptr;
};

/// Moves the atoms of `result` downhill and updates everything in it except `held`; energies and
/// forces only if a potential acts. An end by `out_of_steps` may be that of the descent alone.
///
/// @throws InvalidAtoms  if there is no finite energy at the start.
void descend(RelaxResult& result, const DescentOptions& descent, const RelaxOptions& options);

}  // namespace trivalent::potentials::relax_detail
