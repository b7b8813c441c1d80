#pragma once

#include "rebo/parameters.h"
#include "value_and_slope.h"

namespace trivalent::potentials::rebo_detail {

/// Half a cosine wave from 1 at range.begin to 0 at range.end, [Brenner2002, eq. 10].
[[nodiscard]] ValueAndSlope cosine_switch(double x, Range range);

/// The cubic polynomial from 0 at range.begin to 1 at range.end with no slope at both.
[[nodiscard]] inline ValueAndSlope cubic_rise(double x, Range range) {
  if (x <= range.begin) return {0.0, 0.0};
  if (x >= range.end) return {1.0, 0.0};
  const double width = range.end - range.begin;
  const double t = (x - range.begin) / width;
  return {t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / width};
}

}  // namespace trivalent::potentials::rebo_detail
