#include "rebo/plain_rebo.h"

#include "rebo/bond_list.h"
#include "rebo/bond_order.h"
#include "rebo/gradient.h"
#include "rebo/pair_terms.h"
#include "totals.h"

namespace trivalent::potentials::rebo_detail {

EnergyForces plain_rebo(const AtomsView& atoms, const Parameters& parameters) {
  EnergyForces result;
  set_zero(result, atoms.size());
  const BondList bonds(atoms, parameters);
  Gradient gradient(bonds, result);
  const BondOrder orders(bonds, parameters, &gradient);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const DirectedBond& bond = bonds[b];
    if (bond.reverse < b) continue;  // once a bond, not once a direction
    const auto& constants = parameters.bond(bonds.species(bond.from), bonds.species(bond.to));
    const ValueAndSlope repelled = repulsion(bond.distance, bond.cutoff, constants);
    const ValueAndSlope attracted = attraction(bond.distance, bond.cutoff, constants);
    const double order = orders.bond_order(pair_of(bonds, b), -attracted.value);
    gradient.add_distance(bond, repelled.slope - order * attracted.slope);

    const double energy = repelled.value - order * attracted.value;
    result.energy += energy;
    result.energies[bond.from] += 0.5 * energy;
    result.energies[bond.to] += 0.5 * energy;
  }
  gradient.finish();
  return result;
}

}  // namespace trivalent::potentials::rebo_detail
