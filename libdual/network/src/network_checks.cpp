#include "trivalent/dual/network_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

void check_rings(const Structure& structure) {
  const int n_atoms = static_cast<int>(structure.atoms.size());
  for (std::size_t ring = 0; ring < structure.rings.size(); ++ring) {
    for (const int atom : structure.rings[ring].atoms) {
      if (atom >= 0 && atom < n_atoms) continue;
      throw InvalidNetwork(concat("check_network: ring ", ring, " holds atom ", atom,
                                  "; there are the atoms 0 to ", n_atoms - 1));
    }
  }
}

void measure_bonds(const Structure& structure, NetworkReport& report) {
  if (structure.bonds.empty()) return;
  std::vector<double> lengths;
  lengths.reserve(structure.bonds.size());
  for (const potentials::Bond& bond : structure.bonds) {
    lengths.push_back(potentials::bond_length(structure.atoms, bond));
  }
  report.bond_mean = mean_bond_length(structure);
  double squares = 0.0;
  for (const double length : lengths) {
    squares += (length - report.bond_mean) * (length - report.bond_mean);
  }
  report.bond_spread = std::sqrt(squares / static_cast<double>(lengths.size()));
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  report.bond_min = *shortest;
  report.bond_max = *longest;
}

void count_rings(const Structure& structure, NetworkReport& report) {
  for (const Ring& ring : structure.rings) {
    const int size = static_cast<int>(ring.atoms.size());
    ++report.ring_sizes[size];
    report.ring_excess += 6 - size;
  }
  if (structure.rings.empty()) return;
  const auto hexagons = report.ring_sizes.find(6);
  if (hexagons == report.ring_sizes.end()) return;
  report.hexagon_fraction = static_cast<double>(hexagons->second) / report.rings;
}

}  // namespace

NetworkReport check_network(const Structure& structure) {
  check_rings(structure);
  NetworkReport report;
  report.atoms = static_cast<int>(structure.atoms.size());
  report.bonds = static_cast<int>(structure.bonds.size());
  report.rings = static_cast<int>(structure.rings.size());
  for (const int coordination : coordinations(structure)) ++report.coordinations[coordination];
  count_rings(structure, report);
  measure_bonds(structure, report);
  return report;
}

void check_bonds(const potentials::Atoms& atoms, std::span<const potentials::Bond> bonds) {
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    const auto& [first, second, image] = bonds[i];
    const bool is_loop = first == second && image == std::array<std::int32_t, 3>{0, 0, 0};
    if (std::max(first, second) < atoms.size() && !is_loop) continue;
    throw InvalidNetwork(concat("check_network: bond ", i, " joins atoms ", first, " and ", second,
                                "; bonds join two of the atoms 0 to ",
                                static_cast<std::int64_t>(atoms.size()) - 1));
  }
}

std::vector<int> coordinations(const Structure& structure) {
  check_bonds(structure.atoms, structure.bonds);
  std::vector<int> counts(structure.atoms.size(), 0);
  for (const potentials::Bond& bond : structure.bonds) {
    ++counts[bond.first];
    ++counts[bond.second];
  }
  return counts;
}

std::vector<std::array<int, 3>> ring_sizes_at_atoms(const Structure& structure) {
  check_rings(structure);
  std::vector<std::array<int, 3>> sizes(structure.atoms.size(), {0, 0, 0});
  for (const Ring& ring : structure.rings) {
    for (const int atom : ring.atoms) {
      const auto free = std::find(sizes[atom].begin(), sizes[atom].end(), 0);
      if (free == sizes[atom].end()) {
        throw InvalidNetwork(
            concat("ring_sizes_at_atoms: atom ", atom,
                   " lies in more than three rings; the network must be trivalent"));
      }
      *free = static_cast<int>(ring.atoms.size());
    }
  }
  for (auto& of_atom : sizes) std::sort(of_atom.begin(), of_atom.end(), std::greater<>{});
  return sizes;
}

}  // namespace trivalent::dual
