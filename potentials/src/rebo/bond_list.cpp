#include "rebo/bond_list.h"

#include <algorithm>
#include <tuple>

#include "rebo/cutoff.h"
#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::potentials::rebo_detail {

BondList::BondList(const AtomsView& atoms, const Parameters& parameters)
    : species_(atoms.species), coordinations_(atoms.size()) {
  const NeighborList list(atoms, longest_bond);
  first_.push_back(0);
  for (std::uint32_t i = 0; i < atoms.size(); ++i) {
    for (const Neighbor& neighbor : list[i]) {
      const BondParameters& bond = parameters.bond(species(i), species(neighbor.atom));
      if (neighbor.distance >= bond.cutoff.end) continue;
      const ValueAndSlope cutoff = cosine_switch(neighbor.distance, bond.cutoff);
      bonds_.push_back({.from = i,
                        .to = neighbor.atom,
                        .image = neighbor.image,
                        .reverse = 0,
                        .separation = neighbor.separation,
                        .distance = neighbor.distance,
                        .cutoff = cutoff,
                        .dihedral_cutoff = cosine_switch(neighbor.distance, bond.dihedral_cutoff)});
      coordinations_[i].of(species(neighbor.atom)) += cutoff.value;
    }
    first_.push_back(bonds_.size());
  }
  link_reverse_directions();
}

void BondList::link_reverse_directions() {
  const auto place = [this](std::size_t b) { return std::tuple(bonds_[b].to, bonds_[b].image); };
  for (DirectedBond& bond : bonds_) {
    std::array<std::int32_t, 3> back{};
    for (std::size_t k = 0; k < 3; ++k) back[k] = -bond.image[k];
    // The bonds of an atom are ordered by (atom, image), as its neighbors are.
    const auto others = from(bond.to);
    bond.reverse = *std::ranges::lower_bound(others, std::tuple(bond.from, back), {}, place);
  }
}

}  // namespace trivalent::potentials::rebo_detail
