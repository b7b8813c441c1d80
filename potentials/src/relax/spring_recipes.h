#pragma once

#include <span>
#include <vector>

#include "relax/network_springs.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::potentials::relax_detail {

/// Length of a bond between two elements at rest [Å]: graphene's 1.42, methane's 1.09. Hydrogen
/// makes no network; its bonds to itself have the length of H2, 0.74.
[[nodiscard]] double bond_at_rest(Species a, Species b);

/// Length beyond which a bond is held, as it would tear under REBO alone [Å]: a third into the
/// range over which its cutoff falls off, where the force along a bond is largest. C-C 1.8.
[[nodiscard]] double max_free_bond(Species a, Species b);

/// Whether a rough start is needed: a carbon bond is outside 1.25 to 1.65 Å, or a pair without a
/// bond is within REBO's reach.
[[nodiscard]] bool is_rough(const Atoms& atoms, std::span<const Bond> bonds);

/// Draws a network towards bonds at rest in several parts, so that a surface whose bonds are short
/// swells instead of folding into itself.
class Swelling {
 public:
  Swelling(const Atoms& atoms, std::span<const Bond> bonds);

  [[nodiscard]] int part_count() const { return part_count_; }

  /// Springs for one of the parts, from 1 to part_count().
  ///
  /// @param smoothness  see SpringOptions
  [[nodiscard]] SpringOptions springs(int part, double smoothness) const;

 private:
  std::vector<double> at_rest_;     // length of each bond [Å]
  std::vector<double> logarithms_;  // of the present length by that
  int part_count_ = 1;
};

/// Smoothness of the surface while it swells, and of the last part, which lets it find its own
/// shape [eV/Å²].
inline constexpr double swelling_smoothness = 2.0;
inline constexpr double final_smoothness = 0.5;

/// Where a stage with springs ends: the next one moves the atoms on anyway [eV/Å].
inline constexpr double rough_force = 0.3;

/// Keeps bonds and contacts within bounds while the potential is switched on.
[[nodiscard]] SpringOptions bounding_springs(const Atoms& atoms, std::span<const Bond> bonds);

/// Holds bonds at max_free_bond().
[[nodiscard]] SpringOptions holding_springs(const Atoms& atoms, std::span<const Bond> bonds);

}  // namespace trivalent::potentials::relax_detail
