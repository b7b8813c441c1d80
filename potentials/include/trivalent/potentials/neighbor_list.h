#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials {

/// One neighbor of an atom: another atom, a periodic image of it, or an image of the atom itself.
/// Only `atom` and `image` together say which one it is.
struct Neighbor {
  std::uint32_t atom;                 ///< index into Atoms
  std::array<std::int32_t, 3> image;  ///< it sits at position + cell · image
  Eigen::Vector3d separation;         ///< from the atom to this neighbor [Å]
  double distance;                    ///< length of separation [Å]
};

/// All neighbors of all atoms within a cutoff, both directions of each pair.
///
/// The neighbors of an atom are ordered by (atom, image), so nothing depends on threads. Positions
/// outside a periodic cell are welcome; images are counted from the positions as given.
class NeighborList {
 public:
  /// @param cutoff  [Å], > 0; neighbors are strictly nearer.
  /// @throws InvalidAtoms   if positions and species differ in number, a position is not finite,
  ///                        two atoms coincide, a periodic direction has no or a degenerate cell
  ///                        vector, or there are more than 2^32 - 2 atoms and images.
  /// @throws InvalidOption  if the cutoff is not a positive number.
  ///
  /// Cost: O(n log n + neighbors) time, O(n + neighbors) memory, whatever the size of the box.
  NeighborList(const AtomsView& atoms, double cutoff);

  /// Number of atoms.
  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }

  /// Neighbors of one atom.
  [[nodiscard]] std::span<const Neighbor> operator[](std::size_t atom) const {
    return std::span(neighbors_).subspan(first_[atom], first_[atom + 1] - first_[atom]);
  }

 private:
  std::vector<std::size_t> first_;  // into neighbors_, one more than atoms
  std::vector<Neighbor> neighbors_;
};

}  // namespace trivalent::potentials
