#include "rebo/bond_order.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "rebo/angular_function.h"
#include "rebo/cutoff.h"

namespace trivalent::potentials::rebo_detail {

struct CosineOfAngle {
  double value;
  Eigen::Vector3d slope_a;  // d/da
  Eigen::Vector3d slope_b;
};

namespace {

[[nodiscard]] CosineOfAngle cosine_of_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double length_a = a.norm();
  const double length_b = b.norm();
  const Eigen::Vector3d u = a / length_a;
  const Eigen::Vector3d v = b / length_b;
  const double cosine = std::clamp(u.dot(v), -1.0, 1.0);
  return {cosine, (v - cosine * u) / length_a, (u - cosine * v) / length_b};
}

}  // namespace

Pair pair_of(const BondList& bonds, std::size_t index) {
  const DirectedBond& bond = bonds[index];
  return {bond.from, bond.to, bond.image, bond.separation, bond.distance, std::nullopt, index};
}

Pair reversed(const BondList& bonds, const Pair& pair) {
  Pair back = pair;
  std::swap(back.from, back.to);
  for (std::int32_t& k : back.image) k = -k;
  back.separation = -pair.separation;
  if (pair.bond) back.bond = bonds[*pair.bond].reverse;
  return back;
}

double BondOrder::bond_order(const Pair& pair, double weight) const {
  const Pair back = reversed(bonds_, pair);
  return 0.5 * (sigma(pair, 0.5 * weight) + sigma(back, 0.5 * weight)) + pi(pair, weight);
}

bool BondOrder::is_other_neighbor(const DirectedBond& neighbor, const Pair& pair) const {
  return neighbor.to != pair.to || neighbor.image != pair.image;
}

Coordination BondOrder::coordination_without(const Pair& pair) const {
  Coordination rest = bonds_.coordination(pair.from);
  if (pair.bond) rest.of(bonds_.species(pair.to)) -= bonds_[*pair.bond].cutoff.value;
  return rest;
}

void BondOrder::add_coordination_without(const Pair& pair, const Coordination& slope) const {
  if (pair.bond) {
    gradient_->add_coordination_without(*pair.bond, slope);
  } else {
    gradient_->add_coordination(pair.from, slope);
  }
}

void BondOrder::add_separation(const Pair& pair, const Eigen::Vector3d& slope) const {
  gradient_->add_separation(pair.from, pair.to, pair.separation, slope);
}

// The term of one neighbor k in the sum of p_ij, without its factor f(r_ik).
struct BondOrder::AngleTerm {
  double value;               // g exp(λ)
  double slope_coordination;  // d/dN_ij
  double slope_cosine;
  double slope_lambda_length;  // d/dr_ij = -d/dr_ik, through λ
  CosineOfAngle cosine;
};

BondOrder::AngleTerm BondOrder::angle_term(const Pair& pair, const DirectedBond& neighbor,
                                           double N) const {
  const Species center = bonds_.species(pair.from);
  const CosineOfAngle cosine = cosine_of_angle(pair.separation, neighbor.separation);
  const AngularValue g = angular_function(center, cosine.value, N);
  if (center == Species::carbon) {
    return {g.value, g.slope_coordination, g.slope_cosine, 0.0, cosine};
  }
  // λ compares how far both bonds of the hydrogen are stretched, [Brenner2002, eq. 8].
  const auto preferred = [&](std::uint32_t to) {
    return parameters_.bond(Species::hydrogen, bonds_.species(to)).preferred_length;
  };
  const double stretch = pair.as_if.value_or(pair.distance) - preferred(pair.to);
  const double stretch_of_neighbor = neighbor.distance - preferred(neighbor.to);
  const double factor = std::exp(hydrogen_lambda * (stretch - stretch_of_neighbor));
  return {g.value * factor, 0.0, g.slope_cosine * factor, g.value * factor * hydrogen_lambda,
          cosine};
}

void BondOrder::add_angle(const Pair& pair, std::size_t index, const AngleTerm& term,
                          double weight) const {
  const DirectedBond& neighbor = bonds_[index];
  const double share = weight * neighbor.cutoff.value;
  gradient_->add_cutoff(index, weight * term.value);
  add_separation(pair, share * term.slope_cosine * term.cosine.slope_a);
  gradient_->add_separation(neighbor, share * term.slope_cosine * term.cosine.slope_b);
  if (term.slope_lambda_length == 0.0) return;
  gradient_->add_distance(neighbor, -share * term.slope_lambda_length);
  if (pair.as_if) return;
  add_separation(pair, share * term.slope_lambda_length / pair.distance * pair.separation);
}

double BondOrder::sigma(const Pair& pair, double weight) const {
  const Coordination rest = coordination_without(pair);
  const double N = rest.total();
  double sum = 1.0;
  double slope_coordination = 0.0;
  for (const std::size_t k : bonds_.from(pair.from)) {
    if (!is_other_neighbor(bonds_[k], pair)) continue;
    const AngleTerm term = angle_term(pair, bonds_[k], N);
    sum += bonds_[k].cutoff.value * term.value;
    slope_coordination += bonds_[k].cutoff.value * term.slope_coordination;
  }
  Value2 P{};
  if (bonds_.species(pair.from) == Species::carbon) {
    const bool to_carbon = bonds_.species(pair.to) == Species::carbon;
    P = (to_carbon ? parameters_.p_cc : parameters_.p_ch)(rest.carbon, rest.hydrogen);
  }
  const double p = 1.0 / std::sqrt(sum + P.value);
  if (gradient_ == nullptr) return p;

  const double weight_of_sum = -0.5 * p * p * p * weight;
  for (const std::size_t k : bonds_.from(pair.from)) {
    if (!is_other_neighbor(bonds_[k], pair)) continue;
    add_angle(pair, k, angle_term(pair, bonds_[k], N), weight_of_sum);
  }
  add_coordination_without(pair, {weight_of_sum * (slope_coordination + P.slope_x),
                                  weight_of_sum * (slope_coordination + P.slope_y)});
  return p;
}

BondOrder::Conjugation BondOrder::conjugation(const Pair& pair) const {
  Conjugation result = {coordination_without(pair), 0.0};
  for (const std::size_t k : bonds_.from(pair.from)) {
    const DirectedBond& neighbor = bonds_[k];
    if (!is_other_neighbor(neighbor, pair)) continue;
    if (bonds_.species(neighbor.to) != Species::carbon) continue;
    const double X = bonds_.coordination(neighbor.to).total() - neighbor.cutoff.value;
    result.sum += neighbor.cutoff.value * cosine_switch(X, conjugation_switch).value;
  }
  return result;
}

// Adds weight · dA_i; A_i is the sum in Conjugation.
void BondOrder::add_conjugation(const Pair& pair, double weight) const {
  for (const std::size_t k : bonds_.from(pair.from)) {
    const DirectedBond& neighbor = bonds_[k];
    if (!is_other_neighbor(neighbor, pair)) continue;
    if (bonds_.species(neighbor.to) != Species::carbon) continue;
    const double X = bonds_.coordination(neighbor.to).total() - neighbor.cutoff.value;
    const ValueAndSlope F = cosine_switch(X, conjugation_switch);
    gradient_->add_cutoff(k, weight * F.value);
    if (F.slope == 0.0) continue;
    const double slope_X = weight * neighbor.cutoff.value * F.slope;
    gradient_->add_coordination_without(neighbor.reverse, {slope_X, slope_X});
  }
}

double BondOrder::pi(const Pair& pair, double weight) const {
  const Pair back = reversed(bonds_, pair);
  const Conjugation near = conjugation(pair);
  const Conjugation far = conjugation(back);
  const double N_near = near.coordination.total();
  const double N_far = far.coordination.total();
  const double N_conjugated = 1.0 + near.sum * near.sum + far.sum * far.sum;
  const auto kind = static_cast<std::size_t>(bonds_.species(pair.from)) +
                    static_cast<std::size_t>(bonds_.species(pair.to));
  const Value3 pi = pi_splines[kind](N_near, N_far, N_conjugated);

  constexpr std::size_t carbon_carbon = 0;
  const Value3 T = kind == carbon_carbon ? dihedral_spline(N_near, N_far, N_conjugated) : Value3{};
  const bool is_free_to_turn =
      T.value == 0.0 && T.slope_x == 0.0 && T.slope_y == 0.0 && T.slope_z == 0.0;
  const double D = is_free_to_turn ? 0.0 : dihedral_sum(pair, weight * T.value);
  const double term = pi.value + T.value * D;
  if (gradient_ == nullptr) return term;

  const double slope_near = weight * (pi.slope_x + T.slope_x * D);
  const double slope_far = weight * (pi.slope_y + T.slope_y * D);
  const double slope_conjugated = weight * (pi.slope_z + T.slope_z * D);
  add_coordination_without(pair, {slope_near, slope_near});
  add_coordination_without(back, {slope_far, slope_far});
  add_conjugation(pair, 2.0 * near.sum * slope_conjugated);
  add_conjugation(back, 2.0 * far.sum * slope_conjugated);
  return term;
}

// One neighbor k of an end i of the pair: the plane of the three and how much it counts.
struct BondOrder::Corner {
  std::size_t neighbor;
  Eigen::Vector3d normal;  // separation of the pair × separation of the neighbor
  double share;            // f(r_ik) s(cosθ)
  ValueAndSlope cutoff;    // f
  ValueAndSlope bent;      // s
  CosineOfAngle cosine;
};

// The angle between the planes at both ends.
struct BondOrder::Dihedral {
  const Corner& near;
  const Corner& far;
  double cosine;  // 1 if both neighbors are on the same side
};

BondOrder::Corner BondOrder::corner(const Pair& pair, std::size_t index, Cutoff cutoff) const {
  const DirectedBond& neighbor = bonds_[index];
  const CosineOfAngle cosine = cosine_of_angle(pair.separation, neighbor.separation);
  const ValueAndSlope bent = cubic_rise(cosine.value, straight_angle);
  const ValueAndSlope f = neighbor.*cutoff;
  const Eigen::Vector3d normal = pair.separation.cross(neighbor.separation);
  // Three atoms on a line span no plane.
  constexpr double smallest_sine = 1e-9;
  const bool is_line = normal.norm() < smallest_sine * pair.distance * neighbor.distance;
  return {index, normal, is_line ? 0.0 : f.value * bent.value, f, bent, cosine};
}

void BondOrder::add_corner(const Pair& pair, const Corner& corner, double slope_share,
                           const Eigen::Vector3d& slope_normal) const {
  const DirectedBond& neighbor = bonds_[corner.neighbor];
  gradient_->add_distance(neighbor, slope_share * corner.bent.value * corner.cutoff.slope);
  const double slope_cosine = slope_share * corner.cutoff.value * corner.bent.slope;
  add_separation(pair,
                 slope_cosine * corner.cosine.slope_a + neighbor.separation.cross(slope_normal));
  gradient_->add_separation(
      neighbor, slope_cosine * corner.cosine.slope_b + slope_normal.cross(pair.separation));
}

// The third atom of a three-membered ring is on both ends: no dihedral angle.
bool BondOrder::is_ring_of_three(const Pair& pair, const DirectedBond& near,
                                 const DirectedBond& far) const {
  const Eigen::Vector3i image_of_far =
      Eigen::Vector3i::Map(pair.image.data()) + Eigen::Vector3i::Map(far.image.data());
  return far.to == near.to && image_of_far == Eigen::Vector3i::Map(near.image.data());
}

// Sum of term(dihedral) over the neighbors of both ends; a term returns its value and its slope
// with respect to the cosine, and is then multiplied by how much both planes count.
template <typename Term>
double BondOrder::sum_over_dihedrals(const Pair& pair, double weight, Cutoff cutoff,
                                     const Term& term) const {
  const Pair back = reversed(bonds_, pair);
  double sum = 0.0;
  for (const std::size_t k : bonds_.from(pair.from)) {
    if (!is_other_neighbor(bonds_[k], pair)) continue;
    const Corner near = corner(pair, k, cutoff);
    if (near.share == 0.0) continue;
    for (const std::size_t l : bonds_.from(pair.to)) {
      if (!is_other_neighbor(bonds_[l], back)) continue;
      if (is_ring_of_three(pair, bonds_[k], bonds_[l])) continue;
      const Corner far = corner(back, l, cutoff);
      if (far.share == 0.0) continue;
      const double both = near.normal.norm() * far.normal.norm();
      // The pair runs the other way in the far normal: the same side has opposite normals.
      const Dihedral dihedral = {near, far, -near.normal.dot(far.normal) / both};
      const ValueAndSlope value = term(dihedral);
      sum += value.value * near.share * far.share;
      if (gradient_ != nullptr) add_dihedral(pair, dihedral, value, weight);
    }
  }
  return sum;
}

void BondOrder::add_dihedral(const Pair& pair, const Dihedral& dihedral, ValueAndSlope term,
                             double weight) const {
  const auto& [near, far, cosine] = dihedral;
  const double slope_planes = -weight * term.slope * near.share * far.share;
  const CosineOfAngle planes = cosine_of_angle(near.normal, far.normal);
  add_corner(pair, near, weight * term.value * far.share, slope_planes * planes.slope_a);
  add_corner(reversed(bonds_, pair), far, weight * term.value * near.share,
             slope_planes * planes.slope_b);
}

double BondOrder::dihedral_sum(const Pair& pair, double weight) const {
  return sum_over_dihedrals(
      pair, weight, &DirectedBond::dihedral_cutoff, [](const Dihedral& dihedral) {
        return ValueAndSlope{1.0 - dihedral.cosine * dihedral.cosine, -2.0 * dihedral.cosine};
      });
}

double BondOrder::torsion_sum(const Pair& pair, double weight,
                              std::vector<double>& energies) const {
  return sum_over_dihedrals(pair, weight, &DirectedBond::cutoff, [&](const Dihedral& dihedral) {
    const std::uint32_t k = bonds_[dihedral.near.neighbor].to;
    const std::uint32_t l = bonds_[dihedral.far.neighbor].to;
    const std::size_t kind =
        static_cast<std::size_t>(bonds_.species(k)) + static_cast<std::size_t>(bonds_.species(l));
    const double epsilon = nonbonded_2000[kind].torsion;
    const double half = 0.5 * (1.0 + dihedral.cosine);  // cos²(ω/2)
    const double fourth_power = half * half * half * half;
    const ValueAndSlope term = {epsilon * (256.0 / 405.0 * fourth_power * half - 0.1),
                                epsilon * 256.0 / 405.0 * 2.5 * fourth_power};
    const double quarter = 0.25 * weight * term.value * dihedral.near.share * dihedral.far.share;
    for (const std::uint32_t atom : {pair.from, pair.to, k, l}) energies[atom] += quarter;
    return term;
  });
}

}  // namespace trivalent::potentials::rebo_detail
