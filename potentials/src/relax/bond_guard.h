#pragma once

#include <vector>

#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// Keeps the bonds of a network from tearing: just below the distance at which REBO's bond ends.
class BondGuard {
 public:
  BondGuard(const Atoms& atoms, std::vector<Bond> bonds);

  /// Whether no bond is longer than its limit, or than it was when last accepted.
  [[nodiscard]] bool allows(const Atoms& atoms) const;

  /// From now on, no bond beyond its limit may become longer than it is now.
  void accept(const Atoms& atoms);

 private:
  std::vector<Bond> bonds_;
  std::vector<double> limits_;  // of each bond [Å]
  bool is_any_beyond_ = true;   // longer than usual
};

}  // namespace trivalent::potentials::relax_detail
