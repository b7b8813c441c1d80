#pragma once

#include <compare>
#include <cstdint>

namespace trivalent::dual {

/// The vector i a1 + j a2 of the triangular lattice, where a2 is a1 turned by 60°
/// counter-clockwise. Such vectors multiply as complex numbers do (Eisenstein integers).
struct LatticeVector {
  std::int64_t i = 0;
  std::int64_t j = 0;

  friend auto operator<=>(const LatticeVector&, const LatticeVector&) = default;
  friend LatticeVector operator+(LatticeVector a, LatticeVector b) {
    return {a.i + b.i, a.j + b.j};
  }
  friend LatticeVector operator-(LatticeVector a, LatticeVector b) {
    return {a.i - b.i, a.j - b.j};
  }
  friend LatticeVector operator*(std::int64_t factor, LatticeVector a) {
    return {factor * a.i, factor * a.j};
  }
  /// Turned and scaled as a does with a1.
  friend LatticeVector operator*(LatticeVector a, LatticeVector b) {
    return {a.i * b.i - a.j * b.j, a.i * b.j + a.j * b.i + a.j * b.j};
  }
};

/// a2: the turn by 60°.
inline constexpr LatticeVector sixth_turn = {0, 1};

/// Length squared, in squares of the lattice constant.
[[nodiscard]] inline std::int64_t norm(LatticeVector a) {
  return a.i * a.i + a.i * a.j + a.j * a.j;
}

/// Twice the scalar product.
[[nodiscard]] inline std::int64_t twice_dot(LatticeVector a, LatticeVector b) {
  return 2 * a.i * b.i + a.i * b.j + a.j * b.i + 2 * a.j * b.j;
}

/// Area of the parallelogram of a and b in cells; positive if b is counter-clockwise of a.
[[nodiscard]] inline std::int64_t cross(LatticeVector a, LatticeVector b) {
  return a.i * b.j - a.j * b.i;
}

}  // namespace trivalent::dual
