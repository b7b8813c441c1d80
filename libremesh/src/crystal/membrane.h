#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace trivalent::remesh {

/// A triangulated membrane with the stiffnesses of graphene [Seung1988], in Å and eV:
///
/// E = ½ k Σ (|e| - L_e)²                    stretching, over edges
///   + ½ (κ_d/h²) Σ |c + d - a - b|²         bending, over edges a-b with opposite corners c, d
///   + ½ k_r Σ (r0 - r)²                     self-avoidance, over pairs nearer than r0 that are no
///                                           edge [Kantor1986]
///   + ½ k_t (L/m)² Σ ((x - p)·n)²           tether to the surface: foot p, normal n
///   + ½ k_b (L/m) Σ ((x - p)·b)²            tether of open edges: foot p on the boundary's curve,
///                                           b across it in the surface
///   + ½ k_s (L/m)² Σ w (|x - s| - d0)²      tether of the surface: samples s farther than d0 from
///                                           their vertex, each for w vertices' area
///   + Σ core(valence) + n p                 n edges between a pentagon and a heptagon
///   + ¼ λ (F - F0)²                         F faces: two for each vertex
///   + k_e Σ Δ²                              Δ edges too many or too few on a boundary curve
///   + k_q Σ (Q - Q0)²                       Q: Σ (valence - 4) of a boundary; Q0: of the surface's
///   or, at the end of a given tube, k_c Σ (|C - C0| + |Q - Q0|) + k_e Σ Δ²
///                                           C: sum of a boundary's edges in the net's lattice,
///                                           C0: of the tube that ends there
///
/// k, κ and k_t are the same for every L: those of the continuum. L_e is L between hexagons, and
/// the more the wider the rings at its ends are. The last six are not functions of positions.
struct Membrane {
  static constexpr double fine_length = 2.46;  ///< m [Å]
  static constexpr double bending = 1.4;       ///< κ [eV]

  double length = fine_length;   ///< L [Å]
  double stretching = 13.0;      ///< k [eV/Å²]: (√3/2)·15 eV/Å², Young's modulus of graphene
  double tether = 0.0;           ///< k_t [eV/Å²]
  double boundary_tether = 0.6;  ///< k_b [eV/Å²]
  double cover = 0.0;            ///< k_s [eV/Å²]
  double slack = 4.0;            ///< [Å] that the net may be away from the surface freely
  double repulsion = 13.0;       ///< k_r [eV/Å²]
  double pentagon = 1.0;         ///< core energy [eV]
  double heptagon = -2.1;        ///< core energy [eV]
  double octagon = 1.8;          ///< core energy [eV]
  double pair = 0.0;             ///< p [eV]
  /// How much of the difference of a ring's inner radius from that of a hexagon its edges follow:
  /// 0 to 1.
  double ring_width = 0.0;
  double count = 0.0;  ///< λ [eV]

  [[nodiscard]] double coarseness() const { return length / fine_length; }
  /// L_e [Å] of an edge between vertices whose valences - 6 are these.
  [[nodiscard]] double rest_length(int deviation_a, int deviation_b) const;
  /// κ_d/h² [eV/Å²] with κ_d = 2κ/√3 and h = √3 L/2.
  [[nodiscard]] double hinge_stiffness() const;
  /// r0 [Å]: below it no vertex passes through a triangle.
  [[nodiscard]] double contact_distance() const { return length; }
  /// d0 [Å]: in a flat net no point is farther than L/√3 from a vertex.
  [[nodiscard]] double cover_distance() const { return 0.58 * length + slack; }
  /// [eV] of a vertex with valence - 6 = deviation. Beyond one, each step costs as much as no pair.
  [[nodiscard]] double core_energy(int deviation) const;
  /// The same of a vertex on a boundary with valence - 4 = deviation: a step in the edge of the
  /// net. Topology fixes the sum of all deviations, so that a step takes the place of a pentagon
  /// or heptagon. It is worth half of what these differ by: then neither is preferred to the other.
  [[nodiscard]] double boundary_energy(int deviation) const;
  /// Either of the two.
  [[nodiscard]] double vertex_energy(int deviation, bool is_on_boundary) const {
    return is_on_boundary ? boundary_energy(deviation) : core_energy(deviation);
  }
  /// Whether two vertices of these valences - 6 are a pentagon and a heptagon.
  [[nodiscard]] static bool is_pair(int deviation_a, int deviation_b) {
    return deviation_a * deviation_b == -1;
  }
  /// k_e Δ² [eV] of a boundary curve of this length [Å] with so many edges. A zigzag edge of the
  /// net is as long as its edges, of an armchair edge two reach √3 L: what is between costs
  /// nothing.
  [[nodiscard]] double boundary_count_energy(double curve_length, int edges) const;
  /// k_q (Q - Q0)² [eV] of a boundary that turns by Q - Q0 sixths more than that of the surface.
  [[nodiscard]] double turn_energy(double excess) const;
  /// k_c (|C - C0| + |Q - Q0|) + k_e Δ² [eV] of a boundary that is to be the end of a tube.
  ///
  /// @param distance  |C - C0| + |Q - Q0| [edges, sixths of a turn].
  /// @param excess    Δ: edges more than the shortest path around the tube has.
  [[nodiscard]] double tube_energy(double distance, int excess) const;
  /// ¼ λ (F - F0)² [eV] for F - F0 faces too many.
  [[nodiscard]] double count_energy(int excess) const;
};

/// A vector and 0: a processor's register in single precision.
template <typename Scalar>
using Lanes = Eigen::Matrix<Scalar, 4, 1>;

/// An edge a-b, the corners opposite to it, and the edge's length at rest [Å].
struct Hinge {
  int a, b, c, d;
  float rest = static_cast<float>(Membrane::fine_length);
};

/// Holds vertex i to a plane.
template <typename Scalar>
struct Tether {
  int i;
  Scalar stiffness;  ///< [eV/Å²]
  Lanes<Scalar> foot;
  Lanes<Scalar> normal;
};

/// Pulls vertex i towards a point of the surface once it is too far.
template <typename Scalar>
struct Pull {
  int i;
  Scalar stiffness;  ///< [eV/Å²]
  Lanes<Scalar> point;
};

/// The terms of the energy that depend on positions, by vertex number.
template <typename Scalar>
struct MembraneTerms {
  std::vector<Hinge> hinges = {};
  std::vector<std::array<int, 2>> edges = {};     ///< that have no hinge: on boundaries and creases
  std::vector<std::array<int, 2>> contacts = {};  ///< pairs that may come too near
  std::vector<Tether<Scalar>> tethers = {};
  std::vector<Pull<Scalar>> pulls = {};
};

/// Energy of the terms [eV]; adds its gradient [eV/Å].
///
/// @param x         Positions [Å].
/// @param gradient  As long as x.
template <typename Scalar>
[[nodiscard]] Scalar membrane_energy(const Membrane& membrane, const MembraneTerms<Scalar>& terms,
                                     const std::vector<Lanes<Scalar>>& x,
                                     std::vector<Lanes<Scalar>>& gradient);

}  // namespace trivalent::remesh
