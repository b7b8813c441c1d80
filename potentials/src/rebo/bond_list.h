#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "rebo/parameters.h"
#include "trivalent/potentials/atoms.h"
#include "value_and_slope.h"

namespace trivalent::potentials::rebo_detail {

/// One direction of a bond: `to` as a neighbor of `from`.
struct DirectedBond {
  std::uint32_t from;
  std::uint32_t to;
  std::array<std::int32_t, 3> image;  ///< of `to`
  std::size_t reverse;                ///< index of the other direction
  Eigen::Vector3d separation;         ///< from `from` to this image of `to` [Å]
  double distance;                    ///< [Å]
  ValueAndSlope cutoff;               ///< f(r)
  ValueAndSlope dihedral_cutoff;      ///< f'(r) of the dihedral term
};

/// Numbers of carbon and hydrogen neighbors, fractional inside the switching ranges.
struct Coordination {
  double carbon = 0.0;
  double hydrogen = 0.0;
  [[nodiscard]] double total() const { return carbon + hydrogen; }
  [[nodiscard]] double& of(Species species) {
    return species == Species::carbon ? carbon : hydrogen;
  }
};

/// All pairs nearer than their D_max, in both directions, and the coordinations they add up to.
class BondList {
 public:
  /// @throws InvalidAtoms as NeighborList does.
  BondList(const AtomsView& atoms, const Parameters& parameters);

  [[nodiscard]] const DirectedBond& operator[](std::size_t bond) const { return bonds_[bond]; }
  [[nodiscard]] std::size_t size() const { return bonds_.size(); }

  /// Indices of the bonds that leave an atom.
  [[nodiscard]] auto from(std::uint32_t atom) const {
    return std::views::iota(first_[atom], first_[atom + 1]);
  }

  [[nodiscard]] const Coordination& coordination(std::uint32_t atom) const {
    return coordinations_[atom];
  }
  [[nodiscard]] Species species(std::uint32_t atom) const { return species_[atom]; }

 private:
  void link_reverse_directions();

  std::span<const Species> species_;
  std::vector<std::size_t> first_;
  std::vector<DirectedBond> bonds_;
  std::vector<Coordination> coordinations_;
};

}  // namespace trivalent::potentials::rebo_detail
