#pragma once

#include "rebo/parameters.h"
#include "value_and_slope.h"

namespace trivalent::potentials::rebo_detail {

/// Half a cosine wave from 1 at range.begin to 0 at range.end, [Brenner2002, eq. 10].
[[nodiscard]] ValueAndSlope cosine_switch(double x, Range range);

/// The cubic polynomial from 0 at range.begin to 1 at range.end with no slope at both.
[[nodiscard]] ValueAndSlope cubic_rise(double x, Range range);

}  // namespace trivalent::potentials::rebo_detail
