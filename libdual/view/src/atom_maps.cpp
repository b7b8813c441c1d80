#include "trivalent/view/atom_maps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace trivalent::dual {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr Color no_value = {150, 150, 150};

double strain(const std::vector<BondEnd>& ends, std::span<const potentials::Species> species,
              double bond_length) {
  double sum = 0.0;
  int n_bonds = 0;
  for (const BondEnd& end : ends) {
    if (species[end.atom] != potentials::Species::carbon) continue;
    sum += end.separation.norm() / bond_length - 1.0;
    ++n_bonds;
  }
  return n_bonds > 0 ? 100.0 * sum / n_bonds : none;
}

double pyramidalization(const std::vector<BondEnd>& ends) {
  if (ends.size() != 3) return none;
  const Eigen::Vector3d a = ends[0].separation.normalized();
  const Eigen::Vector3d b = ends[1].separation.normalized();
  const Eigen::Vector3d c = ends[2].separation.normalized();
  // The tips of three unit vectors span a plane; its normal has the same angle with all three.
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const double sine = std::clamp(std::abs(normal.dot(a)), 0.0, 1.0);
  return std::asin(sine) * 180.0 / std::numbers::pi;
}

}  // namespace

std::vector<Category> ring_size_categories() {
  // Okabe and Ito's colors on a quiet grey of hexagons: told apart by all kinds of color vision.
  return {{.value = 0, .label = "none", .color = {150, 150, 150}},
          {.value = 4, .label = "4 or less", .color = {204, 121, 167}},
          {.value = 5, .label = "5", .color = {0, 114, 178}},
          {.value = 6, .label = "6", .color = {222, 222, 216}},
          {.value = 7, .label = "7", .color = {230, 159, 0}},
          {.value = 8, .label = "8 or more", .color = {213, 94, 0}}};
}

std::vector<Category> coordination_categories() {
  return {{.value = 0, .label = "0", .color = {0, 0, 0}},
          {.value = 1, .label = "1", .color = {213, 94, 0}},
          {.value = 2, .label = "2", .color = {230, 159, 0}},
          {.value = 3, .label = "3", .color = {222, 222, 216}},
          {.value = 4, .label = "4 or more", .color = {0, 114, 178}}};
}

Color category_color(std::span<const Category> categories, int value) {
  Color color = categories.front().color;
  int nearest = std::numeric_limits<int>::max();
  for (const Category& category : categories) {
    // 0 means "none" and is nobody's neighbor.
    if ((category.value == 0) != (value == 0)) continue;
    const int distance = std::abs(category.value - value);
    if (distance >= nearest) continue;
    nearest = distance;
    color = category.color;
  }
  return color;
}

Color AtomMap::color(std::size_t atom) const {
  const double value = values[atom];
  if (std::isnan(value)) return no_value;
  if (!categories.empty()) return category_color(categories, static_cast<int>(value));
  return scale.color(value);
}

AtomMap energy_map(std::span<const double> energies, double reference) {
  return {.name = "energy",
          .title = "energy per atom",
          .unit = "eV",
          .values = {energies.begin(), energies.end()},
          .scale = diverging_scale(energies, reference)};
}

AtomMap excess_map(std::span<const double> energies, double reference) {
  std::vector<double> excess(energies.begin(), energies.end());
  for (double& energy : excess) energy -= reference;
  const ColorScale scale = sequential_scale(excess, 0.0);
  return {.name = "excess_energy",
          .title = "energy above graphene",
          .unit = "eV",
          .values = std::move(excess),
          .scale = scale};
}

AtomMap ring_size_map(const std::vector<std::array<int, 3>>& ring_sizes) {
  AtomMap map = {.name = "ring_size",
                 .title = "ring size",
                 .values = {},
                 .categories = ring_size_categories()};
  for (const std::array<int, 3>& sizes : ring_sizes) {
    int oddest = 0;
    for (const int size : sizes) {
      // Sizes come largest first, so the larger of two equally odd ones stays.
      if (size > 0 && (oddest == 0 || std::abs(size - 6) > std::abs(oddest - 6))) oddest = size;
    }
    map.values.push_back(oddest);
  }
  return map;
}

AtomMap coordination_map(const Bonding& bonding) {
  AtomMap map = {.name = "coordination",
                 .title = "coordination",
                 .values = {},
                 .categories = coordination_categories()};
  for (const auto& ends : bonding) map.values.push_back(static_cast<double>(ends.size()));
  return map;
}

AtomMap bond_strain_map(const Bonding& bonding, std::span<const potentials::Species> species,
                        double bond_length) {
  AtomMap map = {
      .name = "bond_strain", .title = "mean strain of its bonds", .unit = "%", .values = {}};
  for (std::size_t i = 0; i < bonding.size(); ++i) {
    const bool is_carbon = species[i] == potentials::Species::carbon;
    map.values.push_back(is_carbon ? strain(bonding[i], species, bond_length) : none);
  }
  map.scale = diverging_scale(map.values, 0.0);
  return map;
}

AtomMap pyramidalization_map(const Bonding& bonding) {
  AtomMap map = {
      .name = "pyramidalization", .title = "pyramidalization angle", .unit = "°", .values = {}};
  for (const auto& ends : bonding) map.values.push_back(pyramidalization(ends));
  map.scale = sequential_scale(map.values, 0.0);
  return map;
}

AtomMap wall_map(std::span<const int> walls) {
  // Neighboring walls differ in color, also of many.
  constexpr std::array<Color, 6> colors = {
      {{0, 114, 178}, {230, 159, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {213, 94, 0}}};
  AtomMap map = {.name = "wall", .title = "wall", .values = {}};
  for (const int wall : walls) map.values.push_back(wall + 1);
  const int n_walls = walls.empty() ? 0 : *std::ranges::max_element(walls) + 1;
  for (int wall = 0; wall < n_walls; ++wall) {
    map.categories.push_back({.value = wall + 1,
                              .label = std::to_string(wall + 1),
                              .color = colors[static_cast<std::size_t>(wall) % colors.size()]});
  }
  return map;
}

AtomMap wall_energy_map(std::vector<double> energies) {
  const ColorScale scale = diverging_scale(energies, 0.0);
  return {.name = "wall_energy",
          .title = "energy by the other walls",
          .unit = "eV",
          .values = std::move(energies),
          .scale = scale};
}

AtomMap distance_map(std::string name, std::string title, std::vector<double> distances) {
  const ColorScale scale = sequential_scale(distances, 0.0);
  return {.name = std::move(name),
          .title = std::move(title),
          .unit = "Å",
          .values = std::move(distances),
          .scale = scale};
}

AtomMap displacement_map(std::span<const Eigen::Vector3d> from,
                         std::span<const Eigen::Vector3d> to) {
  if (from.size() != to.size()) {
    throw InvalidNetwork(concat("displacement_map: ", from.size(), " atoms moved to ", to.size(),
                                " places; there must be as many"));
  }
  std::vector<double> distances;
  for (std::size_t i = 0; i < from.size(); ++i) distances.push_back((to[i] - from[i]).norm());
  return distance_map("displacement", "displacement", std::move(distances));
}

}  // namespace trivalent::dual
