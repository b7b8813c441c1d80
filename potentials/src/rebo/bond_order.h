#pragma once

#include <optional>
#include <vector>

#include "rebo/bond_list.h"
#include "rebo/gradient.h"

namespace trivalent::potentials::rebo_detail {

/// Two atoms whose bond order is asked for, seen from one of them.
///
/// They need not be bonded: AIREBO asks for the bond order two atoms would have.
struct Pair {
  std::uint32_t from;
  std::uint32_t to;
  std::array<std::int32_t, 3> image;  ///< of `to`
  Eigen::Vector3d separation;         ///< from `from` to `to` [Å]
  double distance;                    ///< [Å]
  std::optional<double> as_if;        ///< length to put into λ instead of the distance [Å]
  std::optional<std::size_t> bond;    ///< from → to, if the two are bonded
};

[[nodiscard]] Pair pair_of(const BondList& bonds, std::size_t bond);
[[nodiscard]] Pair reversed(const BondList& bonds, const Pair& pair);

/// Evaluates bond orders. Each function returns one term for one pair and, if there is a gradient,
/// adds `weight` times the derivative of the term to it: weight is the derivative of the energy
/// with respect to the term.
class BondOrder {
 public:
  BondOrder(const BondList& bonds, const Parameters& parameters, Gradient* gradient)
      : bonds_(bonds), parameters_(parameters), gradient_(gradient) {}

  /// b_ij = ½ (p_ij + p_ji) + π_ij + T_ij D_ij, [Brenner2002, eqs. 3, 7, 14-18].
  [[nodiscard]] double bond_order(const Pair& pair, double weight) const;

  /// p_ij = [1 + Σ_k f g exp(λ) + P]^(-1/2) of the end `from`, [Brenner2002, eq. 8].
  [[nodiscard]] double sigma(const Pair& pair, double weight) const;

  /// π_ij + T_ij D_ij, which share coordinations and conjugation, [Brenner2002, eqs. 14-18].
  [[nodiscard]] double pi(const Pair& pair, double weight) const;

  /// D_ij = Σ_kl (1 - cos²Θ_kijl) f f s s, [Brenner2002, eq. 18].
  [[nodiscard]] double dihedral_sum(const Pair& pair, double weight) const;

  /// Σ_kl ε_kl [256/405 cos^10(ω_kijl / 2) - 1/10] f f s s, [Stuart2000, eqs. 15, 16].
  ///
  /// @param energies  gets a quarter of the weighted terms at each of their four atoms
  [[nodiscard]] double torsion_sum(const Pair& pair, double weight,
                                   std::vector<double>& energies) const;

 private:
  struct Conjugation {
    Coordination coordination;  ///< of `from` without `to`
    double sum;                 ///< Σ_k f F(X_ik) over carbon neighbors without `to`
  };

  [[nodiscard]] bool is_other_neighbor(const DirectedBond& neighbor, const Pair& pair) const;
  [[nodiscard]] Coordination coordination_without(const Pair& pair) const;
  [[nodiscard]] Conjugation conjugation(const Pair& pair) const;
  void add_conjugation(const Pair& pair, double weight) const;
  void add_coordination_without(const Pair& pair, const Coordination& slope) const;
  void add_separation(const Pair& pair, const Eigen::Vector3d& slope) const;

  struct AngleTerm;
  [[nodiscard]] AngleTerm angle_term(const Pair& pair, const DirectedBond& neighbor,
                                     double N) const;
  void add_angle(const Pair& pair, std::size_t neighbor, const AngleTerm& term,
                 double weight) const;

  struct Corner;
  struct Dihedral;
  using Cutoff = ValueAndSlope DirectedBond::*;  // which of the two cutoffs a term has
  [[nodiscard]] Corner corner(const Pair& pair, std::size_t neighbor, Cutoff cutoff) const;
  void add_corner(const Pair& pair, const Corner& corner, double slope_share,
                  const Eigen::Vector3d& slope_normal) const;
  [[nodiscard]] bool is_ring_of_three(const Pair& pair, const DirectedBond& near,
                                      const DirectedBond& far) const;
  template <typename Term>
  [[nodiscard]] double sum_over_dihedrals(const Pair& pair, double weight, Cutoff cutoff,
                                          const Term& term) const;
  void add_dihedral(const Pair& pair, const Dihedral& dihedral, ValueAndSlope term,
                    double weight) const;

  const BondList& bonds_;
  const Parameters& parameters_;
  Gradient* gradient_;
};

}  // namespace trivalent::potentials::rebo_detail
