#pragma once

#include "trivalent/potentials/atoms.h"

namespace trivalent::potentials::rebo_detail {

/// An angular function at one angle and one coordination.
struct AngularValue {
  double value;
  double slope_cosine;        ///< d/d cosθ
  double slope_coordination;  ///< d/dN
};

/// g(cosθ, N) of an angle at a carbon or hydrogen [Brenner2002, eqs. 13, 14].
///
/// @param cosine        in [-1, 1]
/// @param coordination  neighbors of the atom at the angle, the other end of the bond not counted
[[nodiscard]] AngularValue angular_function(Species center, double cosine, double coordination);

}  // namespace trivalent::potentials::rebo_detail
