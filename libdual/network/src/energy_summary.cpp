#include "trivalent/dual/energy_summary.h"

#include <algorithm>
#include <numeric>

namespace trivalent::dual {

EnergySummary summarize_energies(std::span<const double> energies, int n_worst) {
  EnergySummary summary;
  if (energies.empty()) return summary;
  summary.total = std::accumulate(energies.begin(), energies.end(), 0.0);
  summary.mean = summary.total / static_cast<double>(energies.size());
  const auto [lowest, highest] = std::minmax_element(energies.begin(), energies.end());
  summary.lowest = *lowest;
  summary.highest = *highest;

  std::vector<int> order(energies.size());
  std::iota(order.begin(), order.end(), 0);
  const auto n_atoms = static_cast<std::ptrdiff_t>(energies.size());
  const auto n_kept = std::clamp<std::ptrdiff_t>(n_worst, 0, n_atoms);
  // Equal energies go by number, so that the list is the same everywhere.
  std::partial_sort(order.begin(), order.begin() + n_kept, order.end(), [&](int a, int b) {
    return energies[a] != energies[b] ? energies[a] > energies[b] : a < b;
  });
  summary.worst.assign(order.begin(), order.begin() + n_kept);
  return summary;
}

}  // namespace trivalent::dual
