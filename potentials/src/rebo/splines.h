#pragma once

#include <array>
#include <initializer_list>

namespace trivalent::potentials::rebo_detail {

/// Value at two integer numbers of neighbors.
struct Knot2 {
  int x;
  int y;
  double value;
};

/// A table over three integers; for a range of z, the same value from first_z to last_z.
struct Knot3 {
  int x;
  int y;
  int first_z;
  int last_z;
  double value;
};

struct Value2 {
  double value;
  double slope_x;
  double slope_y;
};

struct Value3 {
  double value;
  double slope_x;
  double slope_y;
  double slope_z;
};

/// Bicubic Hermite interpolation on the integers 0..4 in both directions, with all derivatives zero
/// at the knots. Arguments outside are moved to the border, where the function goes on flat.
class BicubicSpline {
 public:
  /// Knots that are not listed are zero.
  constexpr BicubicSpline(std::initializer_list<Knot2> knots) {
    for (const Knot2& knot : knots) values_[index(knot.x)][index(knot.y)] = knot.value;
  }
  [[nodiscard]] Value2 operator()(double x, double y) const;

 private:
  [[nodiscard]] static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::array<std::array<double, 5>, 5> values_{};
};

/// Tricubic Hermite interpolation on the integers 0..4, 0..4, 1..9 with given first derivatives and
/// all cross derivatives zero at the knots. Arguments outside are moved to the border.
class TricubicSpline {
 public:
  /// What a table lists; `slope_y` is slope_x with x and y exchanged, as all tables are symmetric.
  struct Table {
    std::initializer_list<Knot3> values;
    std::initializer_list<Knot3> slopes_x = {};
    std::initializer_list<Knot3> slopes_z = {};
  };

  /// Knots that are not listed are zero. Values at (x, y) hold at (y, x) too, and values at 3 hold
  /// at 4 neighbors; slopes do not.
  constexpr explicit TricubicSpline(const Table& table) {
    for (const Knot3& k : table.values) set_symmetric(k, &Node::value);
    for (const Knot3& k : table.slopes_z) set_symmetric(k, &Node::slope_z);
    for (const Knot3& k : table.slopes_x) set(k.x, k.y, k, &Node::slope_x);
    for (const Knot3& k : table.slopes_x) set(k.y, k.x, k, &Node::slope_y);
    for (std::size_t z = 0; z < 9; ++z) {
      for (std::size_t n = 0; n < 4; ++n) {
        nodes_[4][n][z].value = nodes_[3][n][z].value;
        nodes_[n][4][z].value = nodes_[n][3][z].value;
      }
      nodes_[4][4][z].value = nodes_[3][3][z].value;
    }
  }
  [[nodiscard]] Value3 operator()(double x, double y, double z) const;

 private:
  using Node = Value3;

  constexpr void set(int x, int y, const Knot3& knot, double Node::*member) {
    for (int z = knot.first_z; z <= knot.last_z; ++z) {
      nodes_[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)]
            [static_cast<std::size_t>(z - 1)].*
          member = knot.value;
    }
  }
  constexpr void set_symmetric(const Knot3& knot, double Node::*member) {
    set(knot.x, knot.y, knot, member);
    set(knot.y, knot.x, knot, member);
  }

  std::array<std::array<std::array<Node, 9>, 5>, 5> nodes_{};  // z counts from 1
};

}  // namespace trivalent::potentials::rebo_detail
