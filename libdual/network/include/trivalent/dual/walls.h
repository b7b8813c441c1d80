#pragma once

#include <optional>
#include <vector>

#include "trivalent/dual/network_checks.h"
#include "trivalent/dual/shell_checks.h"
#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// The column that says to which of several walls an atom belongs, from 0, the innermost.
inline constexpr const char* wall_column = "wall";

inline constexpr int max_walls = 100;  ///< that a structure may have

/// The wall of every atom; empty if the structure has no such column, one wall only, or numbers
/// that are not below max_walls: another program's column.
[[nodiscard]] std::vector<int> walls_of(const Structure& structure);

/// One of several walls.
struct WallReport {
  int wall = 0;
  NetworkReport network = {};
  /// From its atoms to the nearest atom of the wall before, on average [Å]. None of the first, or
  /// if an atom has none within 8 Å.
  std::optional<double> gap = {};
  std::optional<AtomPair> closest = {};  ///< an atom of it and the nearest of another wall, if any
};

/// What walls are like and how far apart, in their order; empty if there is one.
///
/// @throws InvalidNetwork as check_network; potentials::InvalidAtoms as potentials::NeighborList.
[[nodiscard]] std::vector<WallReport> check_walls(const Structure& structure);

/// Bonds between atoms of different walls.
[[nodiscard]] int bonds_between_walls(const Structure& structure);

}  // namespace trivalent::dual
