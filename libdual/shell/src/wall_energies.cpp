#include "trivalent/shell/wall_energies.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "pair_text.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::shell {

std::vector<double> wall_energies(const dual::Structure& structure,
                                  std::span<const double> energies,
                                  potentials::Potential& potential) {
  const std::vector<int> walls = dual::walls_of(structure);
  if (walls.empty()) return {};
  std::vector<double> gained(energies.begin(), energies.end());
  const int n_walls = *std::ranges::max_element(walls) + 1;
  for (int wall = 0; wall < n_walls; ++wall) {
    const dual::Structure alone =
        dual::part_of(structure, [&](std::size_t atom) { return walls[atom] == wall; });
    if (alone.atoms.size() == 0) continue;
    const potentials::EnergyForces result = potential.evaluate(alone.atoms);
    std::size_t next = 0;
    for (std::size_t atom = 0; atom < walls.size(); ++atom) {
      if (walls[atom] == wall) gained[atom] -= result.energies[next++];
    }
  }
  return gained;
}

Json walls_json(std::span<const dual::WallReport> walls, std::span<const double> energies) {
  Json json = {{"count", walls.size()}};
  if (!energies.empty()) json["energy"] = std::accumulate(energies.begin(), energies.end(), 0.0);
  for (const dual::WallReport& wall : walls) {
    Json one = network_json(wall.network);
    one["gap"] = wall.gap ? Json(*wall.gap) : Json(nullptr);
    one["closest_atom_of_another"] = wall.closest ? Json(wall.closest->distance) : Json(nullptr);
    json["walls"].push_back(std::move(one));
  }
  return json;
}

std::vector<dual::TableRow> walls_rows(std::span<const dual::WallReport> walls,
                                       std::span<const double> energies) {
  if (walls.empty()) return {};
  std::vector<dual::TableRow> rows = {{"walls"}};
  for (const dual::WallReport& wall : walls) {
    std::string text = std::to_string(wall.network.atoms) + " atoms, rings " +
                       histogram_text(wall.network.ring_sizes);
    if (wall.gap) text += ", " + decimals(*wall.gap, 2) + " Å from the wall before";
    if (wall.closest) text += ", nearest atom of another " + pair_text(wall.closest) + " Å";
    rows.push_back({"wall " + std::to_string(wall.wall + 1), text});
  }
  if (!energies.empty()) {
    const double energy = std::accumulate(energies.begin(), energies.end(), 0.0);
    rows.push_back({"energy between walls",
                    decimals(energy, 4) + " eV, " +
                        decimals(1000.0 * energy / static_cast<double>(energies.size()), 1) +
                        " meV/atom"});
  }
  return rows;
}

}  // namespace trivalent::shell
