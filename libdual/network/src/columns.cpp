#include "trivalent/dual/columns.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "trivalent/dual/network_checks.h"

namespace trivalent::dual {
namespace {

// What ASE and others call results of a calculation; they belong to one potential and one geometry.
constexpr std::array<std::string_view, 14> result_keys = {"energy",
                                                          "free_energy",
                                                          "stress",
                                                          "virial",
                                                          "dipole",
                                                          "magmom",
                                                          "virials",
                                                          "Energy",
                                                          "total_energy",
                                                          "enthalpy",
                                                          "polarization",
                                                          "pressure",
                                                          "dielectric_tensor",
                                                          "potential_energy"};
constexpr std::array<std::string_view, 14> result_columns = {"energies",
                                                             "energy",
                                                             "local_energy",
                                                             "atomic_energy",
                                                             "forces",
                                                             "force",
                                                             "stresses",
                                                             "virials",
                                                             "local_virial",
                                                             "magmoms",
                                                             "charges",
                                                             "charge",
                                                             "born_effective_charges",
                                                             "dipoles"};

template <std::size_t n>
bool is_one_of(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

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
  std::erase_if(structure.columns,
                [](const Column& old) { return is_one_of(result_columns, old.name); });
  std::erase_if(structure.header,
                [](const HeaderEntry& old) { return is_one_of(result_keys, old.key); });
  replace_columns(structure, energy_columns(result));
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
