#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <cstdint>

namespace trivalent::remesh {

/// A vector x a1 + y a2 of the triangular lattice of edge 1, where a2 is a1 turned by 60°.
using LatticeVector = Eigen::Matrix<std::int64_t, 2, 1>;

/// Turned by so many times 60°, counter-clockwise.
[[nodiscard]] LatticeVector turned(LatticeVector v, int sixths);
/// Area of the triangle with the sides u and v [triangles of the lattice]: positive where v is to
/// the left of u.
[[nodiscard]] inline std::int64_t area_of(const LatticeVector& u, const LatticeVector& v) {
  return u.x() * v.y() - u.y() * v.x();
}
/// Twice the scalar product.
[[nodiscard]] inline std::int64_t twice_dot(const LatticeVector& u, const LatticeVector& v) {
  return 2 * (u.x() * v.x() + u.y() * v.y()) + u.x() * v.y() + u.y() * v.x();
}
[[nodiscard]] inline double length_of(const LatticeVector& v) {
  return std::sqrt(0.5 * static_cast<double>(twice_dot(v, v)));
}
/// In the plane, with a1 along the real axis.
[[nodiscard]] std::complex<double> in_plane(const LatticeVector& v);

}  // namespace trivalent::remesh
