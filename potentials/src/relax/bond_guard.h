#pragma once

#include <vector>

#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// Says whether the bonds of a network hold.
class BondGuard {
 public:
  BondGuard(const Atoms& atoms, std::vector<Bond> bonds, double limit);

  /// Whether no bond is longer than the limit, or than it was when last accepted.
  [[nodiscard]] bool allows(const Atoms& atoms) const;

  /// Lets no bond that is longer than the limit become longer than it is now.
  void accept(const Atoms& atoms);

 private:
  std::vector<Bond> bonds_;
  double limit_;                // [Å]
  std::vector<double> limits_;  // of each bond, if any is beyond the limit; else empty
};

}  // namespace trivalent::potentials::relax_detail
