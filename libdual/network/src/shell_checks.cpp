#include "trivalent/dual/shell_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::dual {
namespace {

using potentials::Atoms;
using potentials::Species;

bool is_carbon(const Atoms& atoms, std::size_t atom) {
  return atoms.species[atom] == Species::carbon;
}

int count_pieces(const Bonding& bonding) {
  std::vector<bool> is_known(bonding.size());
  std::vector<int> open;
  int pieces = 0;
  for (std::size_t seed = 0; seed < bonding.size(); ++seed) {
    if (is_known[seed]) continue;
    ++pieces;
    is_known[seed] = true;
    open.push_back(static_cast<int>(seed));
    while (!open.empty()) {
      const int atom = open.back();
      open.pop_back();
      for (const BondEnd& end : bonding[static_cast<std::size_t>(atom)]) {
        if (is_known[static_cast<std::size_t>(end.atom)]) continue;
        is_known[static_cast<std::size_t>(end.atom)] = true;
        open.push_back(end.atom);
      }
    }
  }
  return pieces;
}

void count_bonds(const Atoms& atoms, const Bonding& bonding, ShellReport& report) {
  int ends = 0;
  for (std::size_t i = 0; i < bonding.size(); ++i) {
    const int bonds = static_cast<int>(bonding[i].size());
    const int due = is_carbon(atoms, i) ? 3 : 1;
    ends += bonds;
    ++report.coordinations[bonds];
    if (bonds != due) report.odd_atoms.push_back(static_cast<int>(i));
  }
  report.bonds = ends / 2;
}

void count_rings(const Bonding& bonding, const std::vector<Ring>& rings, ShellReport& report) {
  int angles = 0;
  for (const auto& ends : bonding) {
    const int bonds = static_cast<int>(ends.size());
    angles += bonds * (bonds - 1) / 2;
  }
  for (const Ring& ring : rings) {
    const int size = static_cast<int>(ring.atoms.size());
    ++report.ring_sizes[size];
    angles -= size;
  }
  report.angles_without_ring = angles;
}

void measure_bonds(const Atoms& atoms, const Bonding& bonding, ShellReport& report) {
  for (std::size_t i = 0; i < bonding.size(); ++i) {
    if (!is_carbon(atoms, i)) continue;
    for (const BondEnd& end : bonding[i]) {
      if (!is_carbon(atoms, static_cast<std::size_t>(end.atom))) continue;
      const AtomPair bond = {.atoms = {static_cast<int>(i), end.atom},
                             .distance = end.separation.norm()};
      auto& shortest = report.shortest_bond;
      auto& longest = report.longest_bond;
      if (!shortest || bond.distance < shortest->distance) shortest = bond;
      if (!longest || bond.distance > longest->distance) longest = bond;
    }
  }
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

void measure_angles(const Bonding& bonding, ShellReport& report) {
  for (std::size_t i = 0; i < bonding.size(); ++i) {
    const auto& ends = bonding[i];
    for (std::size_t a = 0; a < ends.size(); ++a) {
      for (std::size_t b = a + 1; b < ends.size(); ++b) {
        const BondAngle angle = {.atom = static_cast<int>(i),
                                 .angle = angle_between(ends[a].separation, ends[b].separation)};
        auto& smallest = report.smallest_angle;
        auto& largest = report.largest_angle;
        if (!smallest || angle.angle < smallest->angle) smallest = angle;
        if (!largest || angle.angle > largest->angle) largest = angle;
      }
    }
  }
}

bool are_bonded(const std::vector<BondEnd>& ends, const potentials::Neighbor& neighbor) {
  return std::ranges::any_of(ends, [&](const BondEnd& end) {
    return end.atom == static_cast<int>(neighbor.atom) &&
           std::ranges::equal(end.image, neighbor.image);
  });
}

void find_closest_non_bonded(const Atoms& atoms, const Bonding& bonding, ShellReport& report) {
  const potentials::NeighborList neighbors(atoms, non_bonded_reach);
  std::optional<AtomPair>& closest = report.closest_non_bonded;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    if (!is_carbon(atoms, i)) continue;
    for (const potentials::Neighbor& neighbor : neighbors[i]) {
      if (!is_carbon(atoms, neighbor.atom)) continue;
      if (closest && neighbor.distance >= closest->distance) continue;
      if (are_bonded(bonding[i], neighbor)) continue;
      closest = AtomPair{.atoms = {static_cast<int>(i), static_cast<int>(neighbor.atom)},
                         .distance = neighbor.distance};
    }
  }
}

}  // namespace

int ShellReport::ring_count() const {
  return std::accumulate(ring_sizes.begin(), ring_sizes.end(), 0,
                         [](int sum, const auto& entry) { return sum + entry.second; });
}

ShellReport check_shell(const Atoms& atoms, const Bonding& bonding,
                        const std::vector<Ring>& rings) {
  ShellReport report;
  report.atoms = static_cast<int>(atoms.size());
  report.pieces = count_pieces(bonding);
  count_bonds(atoms, bonding, report);
  count_rings(bonding, rings, report);
  measure_bonds(atoms, bonding, report);
  measure_angles(bonding, report);
  find_closest_non_bonded(atoms, bonding, report);
  return report;
}

}  // namespace trivalent::dual
