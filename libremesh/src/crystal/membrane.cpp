#include "crystal/membrane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace trivalent::remesh {

double Membrane::hinge_stiffness() const {
  const double dihedral = 2.0 * bending / std::numbers::sqrt3;
  const double height = 0.5 * std::numbers::sqrt3 * length;
  return dihedral / (height * height);
}

namespace {

/// The inner radius of a regular ring of equal bonds, over that of a hexagon, less 1.
double widening(int deviation) {
  constexpr int fewest = -3;  // triangles
  static const std::array<double, 16> by_deviation = [] {
    std::array<double, 16> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double size = 6.0 + fewest + static_cast<double>(i);
      table[i] = std::tan(std::numbers::pi / 6.0) / std::tan(std::numbers::pi / size) - 1.0;
    }
    return table;
  }();
  const int last = static_cast<int>(by_deviation.size()) - 1;
  return by_deviation[static_cast<std::size_t>(std::clamp(deviation - fewest, 0, last))];
}

}  // namespace

double Membrane::rest_length(int deviation_a, int deviation_b) const {
  return length * (1.0 + 0.5 * ring_width * (widening(deviation_a) + widening(deviation_b)));
}

namespace {

constexpr double crowded = 6.0;  // [eV] for each step beyond 5 and 7

}  // namespace

double Membrane::core_energy(int deviation) const {
  if (deviation == 0) return 0.0;
  if (deviation == 2) return octagon;
  const int steps = std::abs(deviation);
  const double core = deviation < 0 ? pentagon : heptagon;
  return steps * core + crowded * (steps - 1);
}

double Membrane::boundary_energy(int deviation) const {
  const int steps = std::abs(deviation);
  return 0.5 * (heptagon - pentagon) * deviation + crowded * std::max(steps - 1, 0);
}

namespace {

constexpr double edge_count_stiffness = 50.0;  // k_e [eV]

}  // namespace

double Membrane::boundary_count_energy(double curve_length, int edges) const {
  const double fewest = curve_length / length;
  const double most = fewest * 2.0 / std::numbers::sqrt3;
  const double excess = std::max({0.0, fewest - edges, edges - most});
  return edge_count_stiffness * excess * excess;
}

double Membrane::turn_energy(double excess) const {
  // As much as a pair of 5-7: with 10, dislocations cannot leave the net by its boundary.
  constexpr double stiffness = 4.0;  // k_q [eV]
  return stiffness * excess * excess;
}

double Membrane::tube_energy(double distance, int excess) const {
  constexpr double stiffness = 10.0;  // k_c [eV]
  return stiffness * distance + edge_count_stiffness * excess * excess;
}

double Membrane::count_energy(int excess) const {
  const double vertices = 0.5 * excess;
  return count * vertices * vertices;
}

namespace {

template <typename Scalar>
struct Evaluation {
  const std::vector<Lanes<Scalar>>& x;
  std::vector<Lanes<Scalar>>& gradient;

  [[nodiscard]] const Lanes<Scalar>& position(int i) const {
    return x[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] Lanes<Scalar>& slope(int i) const { return gradient[static_cast<std::size_t>(i)]; }

  /// ½ k (r - rest)² of the distance r between two vertices.
  [[nodiscard]] [[gnu::always_inline]] Scalar spring(int a, int b, Scalar k, Scalar rest) const {
    const Lanes<Scalar> edge = position(b) - position(a);
    const Scalar r = std::sqrt(edge.squaredNorm());
    const Scalar stretch = r - rest;
    const Lanes<Scalar> force = (k * stretch / (r + Scalar(1e-12))) * edge;
    slope(a) -= force;
    slope(b) += force;
    return Scalar(0.5) * k * stretch * stretch;
  }

  struct HingeStiffness {
    Scalar stretching;
    Scalar bending;
  };
  static constexpr std::size_t at_once = 4;

  /// ½ k (|b - a| - L_e)² and ½ k |c + d - a - b|² of four hinges at once: roots and quotients take
  /// longest.
  [[nodiscard]] [[gnu::always_inline]] Scalar bend(std::span<const Hinge, at_once> hinges,
                                                   const HingeStiffness& k) const {
    std::array<Lanes<Scalar>, at_once> edges;
    Eigen::Matrix<Scalar, 4, at_once> squares;
    Lanes<Scalar> rest;
    for (std::size_t i = 0; i < at_once; ++i) {
      edges[i] = position(hinges[i].b) - position(hinges[i].a);
      squares.col(static_cast<Eigen::Index>(i)) = edges[i].cwiseAbs2();
      rest[static_cast<Eigen::Index>(i)] = static_cast<Scalar>(hinges[i].rest);
    }
    squares.transposeInPlace();
    const Lanes<Scalar> r = ((squares.col(0) + squares.col(1)) + squares.col(2)).cwiseSqrt();
    const Lanes<Scalar> stretch = r - rest;
    const Lanes<Scalar> pull = k.stretching * stretch.array() / (r.array() + Scalar(1e-12));
    Lanes<Scalar> bend = Lanes<Scalar>::Zero();
    for (std::size_t i = 0; i < at_once; ++i) {
      const Hinge& h = hinges[i];
      const Lanes<Scalar> q = (position(h.c) + position(h.d)) - (position(h.a) + position(h.b));
      bend += q.cwiseAbs2();
      const Lanes<Scalar> along = pull[static_cast<Eigen::Index>(i)] * edges[i];
      const Lanes<Scalar> across = k.bending * q;
      slope(h.a) -= across + along;
      slope(h.b) -= across - along;
      slope(h.c) += across;
      slope(h.d) += across;
    }
    return Scalar(0.5) * (k.stretching * stretch.squaredNorm() + k.bending * bend.sum());
  }

  /// The same of one hinge.
  [[nodiscard]] Scalar bend(const Hinge& h, const HingeStiffness& k) const {
    const Lanes<Scalar> q = (position(h.c) + position(h.d)) - (position(h.a) + position(h.b));
    const Lanes<Scalar> force = k.bending * q;
    slope(h.a) -= force;
    slope(h.b) -= force;
    slope(h.c) += force;
    slope(h.d) += force;
    return Scalar(0.5) * k.bending * q.squaredNorm() +
           spring(h.a, h.b, k.stretching, static_cast<Scalar>(h.rest));
  }

  [[nodiscard]] Scalar bend(const std::vector<Hinge>& hinges, const HingeStiffness& k) const {
    const std::span all(hinges);
    Scalar energy = 0;
    std::size_t i = 0;
    for (; i + at_once <= all.size(); i += at_once) {
      energy += bend(all.subspan(i).template first<at_once>(), k);
    }
    for (; i < all.size(); ++i) energy += bend(all[i], k);
    return energy;
  }

  [[nodiscard]] Scalar avoid(int a, int b, Scalar k, Scalar nearest) const {
    if ((position(b) - position(a)).squaredNorm() >= nearest * nearest) return Scalar(0);
    return spring(a, b, k, nearest);
  }

  [[nodiscard]] Scalar hold(const Tether<Scalar>& t) const {
    const Scalar height = (position(t.i) - t.foot).dot(t.normal);
    slope(t.i) += (t.stiffness * height) * t.normal;
    return Scalar(0.5) * t.stiffness * height * height;
  }

  [[nodiscard]] Scalar pull(const Pull<Scalar>& p, Scalar reach) const {
    const Lanes<Scalar> away = position(p.i) - p.point;
    const Scalar r = std::sqrt(away.squaredNorm());
    if (r <= reach) return Scalar(0);
    const Scalar excess = r - reach;
    slope(p.i) += (p.stiffness * excess / r) * away;
    return Scalar(0.5) * p.stiffness * excess * excess;
  }
};

}  // namespace

template <typename Scalar>
Scalar membrane_energy(const Membrane& membrane, const MembraneTerms<Scalar>& terms,
                       const std::vector<Lanes<Scalar>>& x, std::vector<Lanes<Scalar>>& gradient) {
  const Evaluation<Scalar> at{x, gradient};
  const auto k = static_cast<Scalar>(membrane.stretching);
  const auto rest = static_cast<Scalar>(membrane.length);
  const auto hinge = static_cast<Scalar>(membrane.hinge_stiffness());
  const auto repulsion = static_cast<Scalar>(membrane.repulsion);
  const auto nearest = static_cast<Scalar>(membrane.contact_distance());
  const auto reach = static_cast<Scalar>(membrane.cover_distance());
  Scalar energy = at.bend(terms.hinges, {.stretching = k, .bending = hinge});
  for (const auto& [a, b] : terms.edges) energy += at.spring(a, b, k, rest);
  for (const auto& [a, b] : terms.contacts) energy += at.avoid(a, b, repulsion, nearest);
  for (const Tether<Scalar>& t : terms.tethers) energy += at.hold(t);
  for (const Pull<Scalar>& p : terms.pulls) energy += at.pull(p, reach);
  return energy;
}

template float membrane_energy(const Membrane&, const MembraneTerms<float>&,
                               const std::vector<Lanes<float>>&, std::vector<Lanes<float>>&);
template double membrane_energy(const Membrane&, const MembraneTerms<double>&,
                                const std::vector<Lanes<double>>&, std::vector<Lanes<double>>&);

}  // namespace trivalent::remesh
