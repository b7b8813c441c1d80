#include "trivalent/dual/build_dual.h"

#include <cmath>

namespace trivalent::dual {

double edge_length_for_bond(double bond) { return std::sqrt(3.0) * bond; }

}  // namespace trivalent::dual
