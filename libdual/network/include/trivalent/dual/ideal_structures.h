#pragma once

#include <optional>

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// What closes the ends and edges of an ideal structure.
enum class Edges {
  periodic,  ///< none: the structure goes on in the next cell
  bare,      ///< atoms with one bond are taken away, those with two stay
  hydrogen   ///< as bare, capped with hydrogen
};

/// A carbon nanotube [Saito1998]: the strip of graphene between two lines across the chiral vector
/// C = n a1 + m a2, rolled up.
struct Nanotube {
  int n = 10;     ///< >= 1
  int m = 10;     ///< >= 0
  int cells = 1;  ///< translational cells along the tube, >= 1
  Edges edges = Edges::periodic;
};

/// The ideal atoms and bonds of a nanotube along z, around the origin. Bonds are as long as those
/// of graphene where they run along the tube; a relaxation settles the rest. The box leaves 20 Å
/// beside the tube.
///
/// @throws InvalidOption if a number is out of its range, the tube is thinner than three lattice
///   constants around, has more than 10 million atoms, or its ends leave no atom.
[[nodiscard]] Structure nanotube(const Nanotube& tube);

/// A nanotube closed by a cap of six pentagons on one end or on both.
struct CappedNanotube {
  int n = 10;           ///< >= 1
  int m = 10;           ///< >= 0
  double length = 0.0;  ///< of the straight part [Å], >= 0; at least so long, to the next ring;
                        ///< that of a fullerene is 0
  std::optional<Edges> open_end =
      {};  ///< bare or hydrogen: what the lower end has in place of a cap
};

/// The ideal atoms, bonds and, where both ends are closed, rings of a capped nanotube along z,
/// around the origin. A cap has its pentagons as near as the tube's lattice allows to where half of
/// an icosahedron has them, and none beside another from circumferences of nine lattice constants
/// on; both ends have the same cap. A relaxation settles the bonds.
///
/// @throws InvalidOption if a number is out of its range, the tube is thinner than five lattice
///   constants around, has more than 10 million atoms or an open end that is periodic.
[[nodiscard]] Structure capped_nanotube(const CappedNanotube& tube);

/// A sheet of graphene in the xy plane, of n_x by n_y rectangular cells of four atoms, zigzag along
/// x.
///
/// @throws InvalidOption if a number is below 1, the sheet has more than 10 million atoms, or its
///   edges leave no atom.
[[nodiscard]] Structure graphene_sheet(int n_x, int n_y, Edges edges);

/// The icosahedral fullerene of N = 20 (h² + hk + k²) atoms [Goldberg1937, Caspar1962], the dual of
/// a triangulated icosahedron, with its atoms on a sphere. Where several h and k make the same N,
/// those of k = 0, then of the largest h, are taken.
///
/// @throws InvalidOption if there is none of so many atoms, or more than 10 million; the message
///   names the nearest that exist.
[[nodiscard]] Structure icosahedral_fullerene(int n_atoms);

/// The fullerenes of 60, 240, ..., 60 k² atoms, one around the other, k up to the number of walls.
/// The column `wall` counts from 0, the innermost.
///
/// @throws InvalidOption if the number of walls is not in 1 to 30.
[[nodiscard]] Structure icosahedral_onion(int n_walls);

}  // namespace trivalent::dual
