#include "mesh/lattice_vector.h"

#include <cmath>
#include <numbers>

namespace trivalent::remesh {

std::int64_t twice_dot(const LatticeVector& u, const LatticeVector& v) {
  return 2 * (u.x() * v.x() + u.y() * v.y()) + u.x() * v.y() + u.y() * v.x();
}

LatticeVector turned(LatticeVector v, int sixths) {
  constexpr int sixths_of_turn = 6;
  const int times = (sixths % sixths_of_turn + sixths_of_turn) % sixths_of_turn;
  for (int i = 0; i < times; ++i) v = LatticeVector(-v.y(), v.x() + v.y());
  return v;
}

std::int64_t area_of(const LatticeVector& u, const LatticeVector& v) {
  return u.x() * v.y() - u.y() * v.x();
}

double length_of(const LatticeVector& v) {
  return std::sqrt(0.5 * static_cast<double>(twice_dot(v, v)));
}

std::complex<double> in_plane(const LatticeVector& v) {
  constexpr double height = 0.5 * std::numbers::sqrt3;
  const auto y = static_cast<double>(v.y());
  return {static_cast<double>(v.x()) + 0.5 * y, height * y};
}

}  // namespace trivalent::remesh
