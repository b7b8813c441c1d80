#pragma once

#include <algorithm>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::dual {

/// coordination (bonds of every atom) and rings (sizes of the three rings around it, largest first,
/// 0 for a ring that the edge of an open network has cut).
///
/// @throws InvalidNetwork as ring_sizes_at_atoms.
[[nodiscard]] std::vector<Column> network_columns(const Structure& structure);

/// energies [eV] and forces [eV/Å], under the names by which ASE knows them.
[[nodiscard]] std::vector<Column> energy_columns(const potentials::EnergyForces& result);

/// The values of a column; none if there is no column of that name and type.
template <typename Value>
[[nodiscard]] const std::vector<Value>* find_column(const Structure& structure,
                                                    std::string_view name) {
  const auto column = std::ranges::find(structure.columns, name, &Column::name);
  if (column == structure.columns.end()) return nullptr;
  return std::get_if<std::vector<Value>>(&column->values);
}

/// Column of the flags that say along which axes an atom may move: 1 where it may.
inline constexpr std::string_view selective_dynamics = "selective_dynamics";

/// Appends columns; older ones of the same names are removed.
void replace_columns(Structure& structure, std::vector<Column> columns);

/// Puts energies and forces into columns and the total [eV] into the header. All results of former
/// calculations go (also stress, virial, dipole, charges, magnetic moments): they were found by
/// another potential, or for other positions.
void add_energies(Structure& structure, const potentials::EnergyForces& result);

/// Adds the column `displacement` [Å]: from where the atoms were to where they are.
void add_displacements(Structure& structure, std::span<const Eigen::Vector3d> before);

}  // namespace trivalent::dual
