#include "rebo/bond_order.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "rebo/angular_function.h"
#include "rebo/cutoff.h"

namespace trivalent::potentials::rebo_detail {

namespace {

struct CosineOfAngle {
  double value;
  Eigen::Vector3d slope_a;  // d/da
  Eigen::Vector3d slope_b;
};

[[nodiscard]] CosineOfAngle cosine_of_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double length_a = a.norm();
  const double length_b = b.norm();
  const Eigen::Vector3d u = a / length_a;
  const Eigen::Vector3d v = b / length_b;
  const double cosine = std::clamp(u.dot(v), -1.0, 1.0);
  return {cosine, (v - cosine * u) / length_a, (u - cosine * v) / length_b};
}

}  // namespace

Pair pair_of(const Bonds& bonds, std::size_t index) {
  const Bond& bond = bonds[index];
  return {bond.from, bond.to, bond.image, bond.separation, bond.distance, std::nullopt, index};
}

Pair reversed(const Bonds& bonds, const Pair& pair) {
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

bool BondOrder::is_other_neighbor(const Bond& neighbor, const Pair& pair) const {
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

BondOrder::AngleTerm BondOrder::angle_term(const Pair& pair, const Bond& neighbor, double N) const {
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
  const Bond& neighbor = bonds_[index];
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
    const Bond& neighbor = bonds_[k];
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
    const Bond& neighbor = bonds_[k];
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
  double share;            // f'(r_ik) s(cosθ)
  CosineOfAngle cosine;
  ValueAndSlope bent;  // s
};

BondOrder::Corner BondOrder::corner(const Pair& pair, std::size_t index) const {
  const Bond& neighbor = bonds_[index];
  const CosineOfAngle cosine = cosine_of_angle(pair.separation, neighbor.separation);
  const ValueAndSlope bent = cubic_rise(cosine.value, straight_angle);
  Corner result = {index, pair.separation.cross(neighbor.separation),
                   neighbor.dihedral_cutoff.value * bent.value, cosine, bent};
  // Three atoms on a line span no plane.
  constexpr double smallest_sine = 1e-9;
  if (result.normal.norm() < smallest_sine * pair.distance * neighbor.distance) result.share = 0.0;
  return result;
}

void BondOrder::add_corner(const Pair& pair, const Corner& corner, double slope_share,
                           const Eigen::Vector3d& slope_normal) const {
  const Bond& neighbor = bonds_[corner.neighbor];
  gradient_->add_distance(neighbor,
                          slope_share * corner.bent.value * neighbor.dihedral_cutoff.slope);
  const double slope_cosine = slope_share * neighbor.dihedral_cutoff.value * corner.bent.slope;
  add_separation(pair,
                 slope_cosine * corner.cosine.slope_a + neighbor.separation.cross(slope_normal));
  gradient_->add_separation(
      neighbor, slope_cosine * corner.cosine.slope_b + slope_normal.cross(pair.separation));
}

// (1 - cos²Θ) of the planes at both ends times how much they count. The sine of an angle is never
// divided by; as a quotient of dot products of the normals, cos²Θ has slopes of the same form.
double BondOrder::dihedral_term(const Pair& pair, const Corner& near, const Corner& far,
                                double weight) const {
  const Eigen::Vector3d& m = near.normal;
  const Eigen::Vector3d& n = far.normal;
  const double overlap = m.dot(n);
  const double both = m.squaredNorm() * n.squaredNorm();
  const double squared_sine = 1.0 - overlap * overlap / both;
  const double share = near.share * far.share;
  if (gradient_ == nullptr) return squared_sine * share;

  const double scale = -2.0 * weight * share * overlap / both;
  const Eigen::Vector3d slope_m = scale * (n - overlap / m.squaredNorm() * m);
  const Eigen::Vector3d slope_n = scale * (m - overlap / n.squaredNorm() * n);
  add_corner(pair, near, weight * squared_sine * far.share, slope_m);
  add_corner(reversed(bonds_, pair), far, weight * squared_sine * near.share, slope_n);
  return squared_sine * share;
}

double BondOrder::dihedral_sum(const Pair& pair, double weight) const {
  const Pair back = reversed(bonds_, pair);
  double sum = 0.0;
  for (const std::size_t k : bonds_.from(pair.from)) {
    if (!is_other_neighbor(bonds_[k], pair)) continue;
    const Corner near = corner(pair, k);
    if (near.share == 0.0) continue;
    for (const std::size_t l : bonds_.from(pair.to)) {
      if (!is_other_neighbor(bonds_[l], back)) continue;
      // The third atom of a three-membered ring is on both ends: no dihedral angle.
      const Eigen::Vector3i image_l =
          Eigen::Vector3i::Map(pair.image.data()) + Eigen::Vector3i::Map(bonds_[l].image.data());
      const bool is_same =
          bonds_[l].to == bonds_[k].to && image_l == Eigen::Vector3i::Map(bonds_[k].image.data());
      if (is_same) continue;
      const Corner far = corner(back, l);
      if (far.share != 0.0) sum += dihedral_term(pair, near, far, weight);
    }
  }
  return sum;
}

}  // namespace trivalent::potentials::rebo_detail
