#include "rebo/force_sums.h"

namespace trivalent::potentials::rebo_detail {
namespace {

constexpr std::uint32_t results_ahead = 32;  // atoms between asking for a result's place and use

}  // namespace

ForceSums::ForceSums(const Candidates& candidates)
    : candidates_(candidates),
      crossings_(without_values<Eigen::Vector4d>(candidates.crossings.size())) {}

// The caller's order may jump about in memory.
void ForceSums::prefetch_result(std::size_t atom, const EnergyForces& result) const {
  const Candidates& c = candidates_;
  if (atom >= c.count()) return;
  __builtin_prefetch(&result.forces[c.order[atom]]);
  __builtin_prefetch(&result.energies[c.order[atom]]);
}

Totals ForceSums::set_tile(std::size_t tile, const TileSlopes& slopes, EnergyForces& result) {
  const Candidates& c = candidates_;
  const std::uint32_t begin = c.tiles[tile];
  const std::uint32_t first_link = c.first[begin];
  const std::uint32_t links = c.first[c.tiles[tile + 1]] - first_link;
  const auto slope = [&](std::uint32_t link) {
    return Eigen::Vector4d::Map(&slopes.links[std::size_t{4} * link]);
  };
  Totals totals;
  totals.virial = slopes.virial;
  for (std::uint32_t i = begin; i < c.tiles[tile + 1]; ++i) {
    prefetch_result(i + results_ahead, result);
    Eigen::Vector4d own = Eigen::Vector4d::Zero();
    Eigen::Vector4d other = Eigen::Vector4d::Zero();
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      own += slope(link - first_link);
      const std::uint32_t back = c.reverse[link] - first_link;  // wraps around if before the tile
      if (back < links) other += slope(back);
    }
    const double energy = slopes.energies[i - begin];
    result.energies[c.order[i]] = energy + other[3];
    result.forces[c.order[i]] = (own - other).head<3>();
    totals.energy += energy + own[3];
  }
  for (std::uint32_t k = c.first_crossing[tile]; k < c.first_crossing[tile + 1]; ++k) {
    crossings_[k] = slope(c.crossings[k].link - first_link);
  }
  return totals;
}

void ForceSums::add_crossings(std::size_t tile, EnergyForces& result) const {
  const Candidates& c = candidates_;
  for (std::uint32_t k = c.first_crossing[tile]; k < c.first_crossing[tile + 1]; ++k) {
    const auto& [atom, link, back] = c.crossings[k];
    result.forces[c.order[atom]] -= crossings_[back].head<3>();
    result.energies[c.order[atom]] += crossings_[back][3];
  }
}

}  // namespace trivalent::potentials::rebo_detail
