#pragma once

#include <span>
#include <vector>

namespace trivalent::dual {

/// Energy per atom of graphene at rest under REBO [eV], where shells of carbon come down to.
inline constexpr double graphene_energy = -7.394997;

/// What the energies of all atoms come to.
struct EnergySummary {
  double total = 0.0;      ///< [eV]
  double mean = 0.0;       ///< [eV per atom]; 0 without atoms
  double lowest = 0.0;     ///< of an atom [eV]
  double highest = 0.0;    ///< of an atom [eV]
  std::vector<int> worst;  ///< atoms of highest energy, highest first
  /// Mean energy above graphene's [eV per atom]; has a meaning under REBO only.
  [[nodiscard]] double excess() const { return mean - graphene_energy; }
};

/// Sums the energies up in their order, and finds the n_worst highest (or all, if there are fewer).
[[nodiscard]] EnergySummary summarize_energies(std::span<const double> energies, int n_worst);

}  // namespace trivalent::dual
