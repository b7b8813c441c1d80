#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "trivalent/dual/dual_size.h"
#include "trivalent/dual/structure.h"
#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/mesh.h"
#include "trivalent/remesh/remesh.h"

namespace trivalent::dual {

/// About so many atoms, in all walls together.
struct AtomCount {
  int atoms = 10000;  ///< >= 20
};
/// What a shell may have more or less than asked for.
inline constexpr double atom_count_tolerance = 0.02;

/// Where further walls are, seen from the given surface.
enum class WallSide { outwards, inwards };

/// Shells around each other, like those of onions and multi-walled tubes.
struct WallOptions {
  int count = 1;         ///< 1 to 100
  double spacing = 3.4;  ///< [Å] from wall to wall, > 0
  WallSide side = WallSide::outwards;
};

/// Size of a shell to be made; a length or scale is that of the given surface.
using ShellSize = std::variant<AtomCount, LongestSide, Scale>;

struct ShellOptions {
  /// None: that of the tubes which the surface is to end in (set_tube_end()), or AtomCount{}.
  std::optional<ShellSize> size = {};
  double bond = default_bond_length;  ///< wanted mean bond length [Å], > 0
  /// How the net is made; its target_edge_length follows from size and bond.
  remesh::RemeshMethod method = {};
  WallOptions walls = {};
};

/// The size that is given, or that is taken instead.
[[nodiscard]] ShellSize size_of(const remesh::TriMesh& surface, const ShellOptions& options);

/// What a shell would come to.
struct ShellEstimate {
  double atoms = 0.0;        ///< as many as equilateral triangles fit the area
  double edge_length = 0.0;  ///< of these [unit of the input]
  double scale = 0.0;        ///< [Å per unit of the input]
};

/// A cheap look before the work.
///
/// @throws InvalidOption  if size or bond is out of its range.
/// @throws InvalidNetwork if the mesh has no faces, no area or no extent.
[[nodiscard]] ShellEstimate estimate_shell(const remesh::TriMesh& mesh,
                                           const ShellOptions& options);

/// A carbon shell and the surface it is the dual of, both in Å.
struct Shell {
  remesh::RemeshResult surface;
  Structure structure;
  double scale = 1.0;               ///< [Å per unit of the input]
  double target_edge_length = 0.0;  ///< of the remeshing that was taken [unit of the input]
  int remeshings = 0;               ///< made until the number of atoms fitted, or of all walls
  /// From 0, the innermost; one per atom. Empty if there is one wall.
  std::vector<int> wall_of_atom = {};
  int given_wall = 0;                   ///< the one on the given surface
  std::vector<std::string> notes = {};  ///< what was found on the way, for people
};

/// Remeshes a surface so that its dual has the wanted size and bonds, and takes the dual.
///
/// Given a number of atoms, the edge length comes from the area, and is corrected until the number
/// is met to atom_count_tolerance; of three remeshings the one that comes nearest is taken if none
/// meets it. The mean bond is exactly the wanted one. Given a length or a scale, that is met
/// exactly, and bonds follow the wanted length as closely as edges their target.
///
/// Further walls are nets of the surface at the given distance from the wall before, held to it
/// about as strongly as graphite's layers hold each other.
///
/// @throws InvalidOption         if size or bond is out of its range.
/// @throws InvalidNetwork        if the mesh has no faces or no extent, or the remeshed one no
/// dual.
/// @throws remesh::InvalidMesh   if there is no room for so many walls; the message says for how
/// many.
/// @throws remesh::InvalidOption as remesh().
[[nodiscard]] Shell build_shell(const remesh::TriMesh& mesh, const ShellOptions& options);

}  // namespace trivalent::dual
