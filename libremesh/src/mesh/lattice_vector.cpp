#include "mesh/lattice_vector.h"

#include <numbers>

namespace trivalent::remesh {

LatticeVector turned(LatticeVector v, int sixths) {
  constexpr int sixths_of_turn = 6;
  const int times = (sixths % sixths_of_turn + sixths_of_turn) % sixths_of_turn;
  for (int i = 0; i < times; ++i) v = LatticeVector(-v.y(), v.x() + v.y());
  return v;
}

std::complex<double> in_plane(const LatticeVector& v) {
  constexpr double height = 0.5 * std::numbers::sqrt3;
  const auto y = static_cast<double>(v.y());
  return {static_cast<double>(v.x()) + 0.5 * y, height * y};
}

}  // namespace trivalent::remesh
