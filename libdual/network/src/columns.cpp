#include "trivalent/dual/columns.h"

#include <algorithm>

#include "trivalent/dual/network_checks.h"

namespace trivalent::dual {

std::vector<Column> network_columns(const Structure& structure) {
  return {{.name = "coordination", .values = coordinations(structure)},
          {.name = "rings", .values = ring_sizes_at_atoms(structure)}};
}

std::vector<Column> energy_columns(const potentials::EnergyForces& result) {
  return {{.name = "energies", .values = result.energies},
          {.name = "forces", .values = result.forces}};
}

void replace_columns(Structure& structure, std::vector<Column> columns) {
  for (Column& column : columns) {
    std::erase_if(structure.columns, [&](const Column& old) { return old.name == column.name; });
    structure.columns.push_back(std::move(column));
  }
}

void add_energies(Structure& structure, const potentials::EnergyForces& result) {
  replace_columns(structure, energy_columns(result));
  std::erase_if(structure.header, [](const HeaderEntry& old) { return old.key == "energy"; });
  structure.header.push_back({.key = "energy", .value = result.energy});
}

void add_displacements(Structure& structure, std::span<const Eigen::Vector3d> before) {
  std::vector<Eigen::Vector3d> displacements(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    displacements[i] = structure.atoms.positions[i] - before[i];
  }
  replace_columns(structure, {{.name = "displacement", .values = std::move(displacements)}});
}

}  // namespace trivalent::dual
