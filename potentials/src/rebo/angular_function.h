#pragma once

#include "trivalent/potentials/atoms.h"
#include "value_and_slope.h"

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

/// What g is blended of, at one angle: the same for both bonds that form it.
struct AngularShapes {
  ValueAndSlope few;   ///< at an atom with few neighbors, or at a hydrogen
  ValueAndSlope many;  ///< at a carbon with many; zero if it has too few for any bond to need it
};
/// @param coordination  of the atom at the angle, all neighbors counted
[[nodiscard]] AngularShapes angular_shapes(Species center, double cosine, double coordination);

/// Share of `few` in g at a coordination.
[[nodiscard]] ValueAndSlope share_of_few(Species center, double coordination);

[[nodiscard]] inline AngularValue blended(const AngularShapes& g, ValueAndSlope share) {
  if (share.value == 1.0) return {g.few.value, g.few.slope, 0.0};
  return {g.many.value + share.value * (g.few.value - g.many.value),
          g.many.slope + share.value * (g.few.slope - g.many.slope),
          share.slope * (g.few.value - g.many.value)};
}

}  // namespace trivalent::potentials::rebo_detail
