#include "trivalent/dual/network_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

void check_bonds(const Network& network) {
  const int n_atoms = static_cast<int>(network.positions.size());
  for (std::size_t bond = 0; bond < network.bonds.size(); ++bond) {
    const auto [first, second] = network.bonds[bond];
    if (first < 0 || second < 0 || first >= n_atoms || second >= n_atoms || first == second) {
      throw InvalidNetwork(concat("check_network: bond ", bond, " joins atoms ", first, " and ",
                                  second, "; bonds join two of the atoms 0 to ", n_atoms - 1));
    }
  }
}

void check_rings(const Network& network) {
  const int n_atoms = static_cast<int>(network.positions.size());
  for (std::size_t ring = 0; ring < network.rings.size(); ++ring) {
    for (const int atom : network.rings[ring]) {
      if (atom >= 0 && atom < n_atoms) continue;
      throw InvalidNetwork(concat("check_network: ring ", ring, " holds atom ", atom,
                                  "; there are the atoms 0 to ", n_atoms - 1));
    }
  }
}

void measure_bonds(const Network& network, NetworkReport& report) {
  if (network.bonds.empty()) return;
  std::vector<double> lengths;
  lengths.reserve(network.bonds.size());
  for (const auto& [first, second] : network.bonds) {
    lengths.push_back((network.positions[first] - network.positions[second]).norm());
  }
  report.bond_mean = mean_bond_length(network);
  double squares = 0.0;
  for (const double length : lengths) {
    squares += (length - report.bond_mean) * (length - report.bond_mean);
  }
  report.bond_spread = std::sqrt(squares / static_cast<double>(lengths.size()));
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  report.bond_min = *shortest;
  report.bond_max = *longest;
}

void count_rings(const Network& network, NetworkReport& report) {
  for (const auto& ring : network.rings) {
    const int size = static_cast<int>(ring.size());
    ++report.ring_sizes[size];
    report.ring_excess += 6 - size;
  }
  if (network.rings.empty()) return;
  const auto hexagons = report.ring_sizes.find(6);
  if (hexagons == report.ring_sizes.end()) return;
  report.hexagon_fraction = static_cast<double>(hexagons->second) / report.rings;
}

}  // namespace

NetworkReport check_network(const Network& network) {
  check_rings(network);
  NetworkReport report;
  report.atoms = static_cast<int>(network.positions.size());
  report.bonds = static_cast<int>(network.bonds.size());
  report.rings = static_cast<int>(network.rings.size());
  for (const int coordination : coordinations(network)) ++report.coordinations[coordination];
  count_rings(network, report);
  measure_bonds(network, report);
  return report;
}

std::vector<int> coordinations(const Network& network) {
  check_bonds(network);
  std::vector<int> counts(network.positions.size(), 0);
  for (const auto& [first, second] : network.bonds) {
    ++counts[first];
    ++counts[second];
  }
  return counts;
}

std::vector<std::array<int, 3>> ring_sizes_at_atoms(const Network& network) {
  check_rings(network);
  return ring_sizes_at_atoms(network.rings, network.positions.size());
}

std::vector<std::array<int, 3>> ring_sizes_at_atoms(const std::vector<std::vector<int>>& rings,
                                                    std::size_t n_atoms) {
  std::vector<std::array<int, 3>> sizes(n_atoms, {0, 0, 0});
  for (const auto& ring : rings) {
    for (const int atom : ring) {
      const auto free = std::find(sizes[atom].begin(), sizes[atom].end(), 0);
      if (free == sizes[atom].end()) {
        throw InvalidNetwork(
            concat("ring_sizes_at_atoms: atom ", atom,
                   " lies in more than three rings; the network must be trivalent"));
      }
      *free = static_cast<int>(ring.size());
    }
  }
  for (auto& of_atom : sizes) std::sort(of_atom.begin(), of_atom.end(), std::greater<>{});
  return sizes;
}

}  // namespace trivalent::dual
