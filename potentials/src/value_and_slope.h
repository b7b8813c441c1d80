#pragma once

namespace trivalent::potentials {

/// A function of one variable at one point: its value and its derivative there.
struct ValueAndSlope {
  double value;
  double slope;
};

}  // namespace trivalent::potentials
