#include "trivalent/dual/walls.h"

#include <algorithm>
#include <limits>
#include <set>

#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::dual {
namespace {

constexpr double reach = 8.0;  // [Å] to the atoms of other walls
constexpr double far = std::numeric_limits<double>::infinity();

/// Looks at the pairs of atoms of different walls.
class Gaps {
 public:
  Gaps(const Structure& structure, const std::vector<int>& walls)
      : walls_(walls), neighbors_(structure.atoms, reach) {}

  /// Of an atom, the nearest atom of a wall that belongs to what is wanted.
  template <typename Wanted>
  [[nodiscard]] AtomPair nearest(std::size_t atom, const Wanted& wanted) const {
    AtomPair pair = {.atoms = {static_cast<int>(atom), -1}, .distance = far};
    for (const potentials::Neighbor& other : neighbors_[atom]) {
      if (!wanted(walls_[other.atom]) || other.distance >= pair.distance) continue;
      pair = {.atoms = {static_cast<int>(atom), static_cast<int>(other.atom)},
              .distance = other.distance};
    }
    return pair;
  }

  [[nodiscard]] std::optional<AtomPair> closest(int wall) const {
    AtomPair closest = {.atoms = {}, .distance = far};
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      if (walls_[i] != wall) continue;
      const AtomPair pair = nearest(i, [&](int other) { return other != wall; });
      if (pair.distance < closest.distance) closest = pair;
    }
    if (closest.distance == far) return std::nullopt;
    return closest;
  }

  /// Mean distance to the wall before.
  [[nodiscard]] std::optional<double> gap(int wall, int before) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      if (walls_[i] != wall) continue;
      sum += nearest(i, [&](int other) { return other == before; }).distance;
      ++count;
    }
    if (count == 0 || sum == far) return std::nullopt;
    return sum / count;
  }

 private:
  const std::vector<int>& walls_;
  potentials::NeighborList neighbors_;
};

}  // namespace

std::vector<int> walls_of(const Structure& structure) {
  for (const Column& column : structure.columns) {
    const auto* walls = std::get_if<std::vector<int>>(&column.values);
    if (column.name != wall_column || walls == nullptr) continue;
    const bool is_one =
        std::ranges::adjacent_find(*walls, std::ranges::not_equal_to()) == walls->end();
    const bool are_numbers =
        std::ranges::all_of(*walls, [](int wall) { return wall >= 0 && wall < max_walls; });
    if (walls->size() == structure.atoms.size() && !is_one && are_numbers) return *walls;
  }
  return {};
}

std::vector<WallReport> check_walls(const Structure& structure) {
  const std::vector<int> walls = walls_of(structure);
  if (walls.empty()) return {};
  const Gaps gaps(structure, walls);
  std::vector<WallReport> reports;
  for (const int wall : std::set<int>(walls.begin(), walls.end())) {
    const Structure part =
        part_of(structure, [&](std::size_t atom) { return walls[atom] == wall; });
    WallReport report = {.wall = wall, .network = check_network(part)};
    if (!reports.empty()) report.gap = gaps.gap(wall, reports.back().wall);
    report.closest = gaps.closest(wall);
    reports.push_back(std::move(report));
  }
  return reports;
}

int bonds_between_walls(const Structure& structure) {
  const std::vector<int> walls = walls_of(structure);
  if (walls.empty()) return 0;
  return static_cast<int>(std::ranges::count_if(structure.bonds, [&](const potentials::Bond& bond) {
    return walls[bond.first] != walls[bond.second];
  }));
}

}  // namespace trivalent::dual
