#pragma once

#include <memory>

#include "relax/bond_laplacian.h"
#include "relax/objective.h"

namespace trivalent::potentials::relax_detail {

/// Goes downhill step by step.
class Minimization {
 public:
  Minimization() = default;
  Minimization(const Minimization&) = delete;
  Minimization& operator=(const Minimization&) = delete;
  virtual ~Minimization() = default;

  /// Moves the point once, which has energy and gradient before and after. Returns false, with the
  /// point where it was, if there is no way on.
  [[nodiscard]] virtual bool step(Objective& objective, Point& point) = 0;
};

[[nodiscard]] std::unique_ptr<Minimization> make_fire(double max_move);
/// @param network  preconditions, if there is one; it must outlive the minimization.
[[nodiscard]] std::unique_ptr<Minimization> make_lbfgs(double max_move,
                                                       const BondLaplacian* network);

}  // namespace trivalent::potentials::relax_detail
