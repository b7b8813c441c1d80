#pragma once

#include <memory>

#include "relax/bond_laplacian.h"
#include "relax/objective.h"

namespace trivalent::potentials::relax_detail {

/// Moves a point downhill, step by step.
class Minimization {
 public:
  Minimization() = default;
  Minimization(const Minimization&) = delete;
  Minimization& operator=(const Minimization&) = delete;
  virtual ~Minimization() = default;

  /// Moves the point once; it has energy and gradient before and after. Returns false, and leaves
  /// the point where it was, if no step lowers the energy.
  [[nodiscard]] virtual bool step(Objective& objective, Point& point) = 0;
};

[[nodiscard]] std::unique_ptr<Minimization> make_fire(double max_move);
/// @param preconditioner  May be none; must outlive the minimization.
[[nodiscard]] std::unique_ptr<Minimization> make_lbfgs(double max_move,
                                                       const BondLaplacian* preconditioner);

}  // namespace trivalent::potentials::relax_detail
