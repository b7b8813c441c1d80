#include "rebo/general_atom.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "rebo/angular_function.h"
#include "rebo/cutoff.h"
#include "rebo/pair_terms.h"

namespace trivalent::potentials::rebo_detail {

Coordination Surroundings::coordination(std::uint32_t atom) const {
  return states[atom] & atom_state::irregular ? coordinations[atom] : Coordination{3.0, 0.0};
}

void GeneralAtom::load(std::uint32_t atom, Center& center) const {
  const Candidates& c = in_.candidates;
  center.atom = atom;
  center.species = c.species[atom];
  center.coordination = in_.coordination(atom);
  center.conjugation = 0.0;
  center.neighbors.clear();
  for (std::uint32_t link = c.first[atom]; link < c.first[atom + 1]; ++link) {
    const std::uint32_t other = c.home(c.point[link]);
    const BondParameters& bond = in_.parameters.bond(center.species, c.species[other]);
    const Eigen::Vector3d separation = in_.separation(atom, link);
    const double r = separation.norm();
    if (r >= bond.cutoff.end) continue;
    Neighbor neighbor = {.link = link,
                         .atom = other,
                         .species = c.species[other],
                         .separation = separation,
                         .direction = separation / r,
                         .r = r,
                         .f = cosine_switch(r, bond.cutoff),
                         .f_dihedral = {},
                         .F = {0.0, 0.0},
                         .slope = Eigen::Vector3d::Zero(),
                         .slope_f = 0.0,
                         .slope_X = 0.0};
    // The two cutoffs are one function, except between carbon and hydrogen.
    neighbor.f_dihedral = bond.dihedral_cutoff.end == bond.cutoff.end
                              ? neighbor.f
                              : cosine_switch(r, bond.dihedral_cutoff);
    if (neighbor.species == Species::carbon) {
      const double X = in_.coordination(other).total() - neighbor.f.value;
      neighbor.F = cosine_switch(X, conjugation_switch);
      center.conjugation += neighbor.f.value * neighbor.F.value;
    }
    center.neighbors.push_back(neighbor);
  }
}

void GeneralAtom::start(std::uint32_t atom) {
  load(atom, near_);
  energy_ = 0.0;
  slope_coordination_ = {};
  due_.assign(near_.neighbors.size(), 0.0);
}

void GeneralAtom::evaluate(std::uint32_t atom) {
  start(atom);
  for (std::size_t j = 0; j < near_.neighbors.size(); ++j) evaluate_bond(j);
  clear_links();
  out_.energies[atom - out_.first_atom] = 0.0;
  write();
}

void GeneralAtom::add_other_pi(std::uint32_t atom) {
  start(atom);
  for (std::size_t j = 0; j < near_.neighbors.size(); ++j) {
    const std::uint8_t states = in_.states[atom] | in_.states[near_.neighbors[j].atom];
    if ((states & atom_state::unconjugated) != 0) evaluate_pi(j);
  }
  write();
}

void GeneralAtom::evaluate_pi(std::size_t j) {
  Neighbor& bond = near_.neighbors[j];
  const ValueAndSlope attracted =
      attraction(bond.r, in_.parameters.bond(near_.species, bond.species));
  double pi = 0.0;
  add_pi(j, -attracted.value, pi);
  energy_ -= 0.5 * attracted.value * pi;
  bond.slope -= 0.5 * attracted.slope * pi * bond.direction;
}

// The half of the bond's energy that belongs to this atom, and the derivatives it is in charge of.
void GeneralAtom::evaluate_bond(std::size_t j) {
  Neighbor& bond = near_.neighbors[j];
  const BondParameters& constants = in_.parameters.bond(near_.species, bond.species);
  const ValueAndSlope repelled = repulsion(bond.r, constants);
  const ValueAndSlope attracted = attraction(bond.r, constants);
  const double sigma = add_sigma(j, attracted.value);
  double pi = 0.0;
  add_pi(j, -attracted.value, pi);
  due_[j] = -0.25 * attracted.value * sigma;
  energy_ += 0.5 * (repelled.value - attracted.value * pi) + due_[j];
  bond.slope += 0.5 * (repelled.slope - attracted.slope * (sigma + pi)) * bond.direction;
}

void GeneralAtom::add_coordination_without(std::size_t j, Coordination slope) {
  slope_coordination_.carbon += slope.carbon;
  slope_coordination_.hydrogen += slope.hydrogen;
  near_.neighbors[j].slope_f -= slope.of(near_.neighbors[j].species);
}

void GeneralAtom::add_slope_of_cosine(std::size_t j, std::size_t k, double cosine, double slope) {
  Neighbor& a = near_.neighbors[j];
  Neighbor& b = near_.neighbors[k];
  a.slope += slope / a.r * (b.direction - cosine * a.direction);
  b.slope += slope / b.r * (a.direction - cosine * b.direction);
}

// Returns p of the bond; half of it weighs -V_A in the energy.
double GeneralAtom::add_sigma(std::size_t j, double attracted) {
  std::vector<Neighbor>& neighbors = near_.neighbors;
  Coordination rest = near_.coordination;
  rest.of(neighbors[j].species) -= neighbors[j].f.value;
  const bool is_carbon = near_.species == Species::carbon;
  const auto stretch = [&](const Neighbor& n) {
    return n.r - in_.parameters.bond(Species::hydrogen, n.species).preferred_length;
  };
  struct Angle {
    double cosine;
    AngularValue g;
    double factor;
  };
  const auto angle = [&](std::size_t k) {
    const double cosine = std::clamp(neighbors[j].direction.dot(neighbors[k].direction), -1.0, 1.0);
    const AngularValue g = angular_function(near_.species, cosine, rest.total());
    const double lambda =
        is_carbon ? 0.0 : hydrogen_lambda * (stretch(neighbors[j]) - stretch(neighbors[k]));
    return Angle{cosine, g, lambda == 0.0 ? 1.0 : std::exp(lambda)};
  };
  constexpr std::size_t most_kept = 16;
  std::array<Angle, most_kept> kept;
  Value2 P{};
  if (is_carbon) {
    const bool to_carbon = neighbors[j].species == Species::carbon;
    P = (to_carbon ? in_.parameters.p_cc : in_.parameters.p_ch)(rest.carbon, rest.hydrogen);
  }
  double sum = 1.0 + P.value;
  double slope_coordination = 0.0;
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    if (k == j) continue;
    const Angle term = angle(k);
    if (k < most_kept) kept[k] = term;
    sum += neighbors[k].f.value * term.g.value * term.factor;
    slope_coordination += neighbors[k].f.value * term.g.slope_coordination * term.factor;
  }
  const double p = 1.0 / std::sqrt(sum);

  const double weight = 0.25 * attracted * p / sum;  // dE/d(sum)
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    if (k == j) continue;
    const Angle term = k < most_kept ? kept[k] : angle(k);
    Neighbor& neighbor = neighbors[k];
    const double value = weight * term.g.value * term.factor;
    neighbor.slope_f += value;
    const double share = weight * neighbor.f.value * term.factor;
    add_slope_of_cosine(j, k, term.cosine, share * term.g.slope_cosine);
    if (is_carbon) continue;
    const double slope_stretch = value * neighbor.f.value * hydrogen_lambda;
    neighbors[j].slope += slope_stretch * neighbors[j].direction;
    neighbor.slope -= slope_stretch * neighbor.direction;
  }
  add_coordination_without(
      j, {weight * (slope_coordination + P.slope_x), weight * (slope_coordination + P.slope_y)});
  return p;
}

// Sets order to π + T D; weight is the derivative of the energy with respect to it.
void GeneralAtom::add_pi(std::size_t j, double weight, double& order) {
  const Neighbor& bond = near_.neighbors[j];
  load(bond.atom, far_);
  const std::uint32_t back_link = in_.candidates.reverse[bond.link];
  const auto back = static_cast<std::size_t>(
      std::ranges::find(far_.neighbors, back_link, &Neighbor::link) - far_.neighbors.begin());
  const Neighbor& opposite = far_.neighbors[back];
  const double N_near = near_.coordination.total() - bond.f.value;
  const double N_far = far_.coordination.total() - bond.f.value;
  const double conjugation_near = near_.conjugation - bond.f.value * bond.F.value;
  const double conjugation_far = far_.conjugation - opposite.f.value * opposite.F.value;
  const double N_conjugated =
      1.0 + conjugation_near * conjugation_near + conjugation_far * conjugation_far;
  const auto kind =
      static_cast<std::size_t>(near_.species) + static_cast<std::size_t>(bond.species);
  const Value3 pi = pi_splines[kind](N_near, N_far, N_conjugated);

  constexpr std::size_t carbon_carbon = 0;
  const Value3 T = kind == carbon_carbon ? dihedral_spline(N_near, N_far, N_conjugated) : Value3{};
  const bool is_free_to_turn = T.value == 0.0 && T.slope_x == 0.0 && T.slope_z == 0.0;
  const double D = is_free_to_turn ? 0.0 : add_dihedral(j, back, weight * T.value);
  order = pi.value + T.value * D;

  const double slope_near = weight * (pi.slope_x + T.slope_x * D);
  add_coordination_without(j, {slope_near, slope_near});
  const double slope_sum = 2.0 * conjugation_near * weight * (pi.slope_z + T.slope_z * D);
  for (std::size_t k = 0; k < near_.neighbors.size(); ++k) {
    Neighbor& neighbor = near_.neighbors[k];
    if (k == j || neighbor.species != Species::carbon) continue;
    const double slope_X = slope_sum * neighbor.f.value * neighbor.F.slope;
    neighbor.slope_f += slope_sum * neighbor.F.value - slope_X;
    neighbor.slope_X += slope_X;
  }
}

void GeneralAtom::find_planes(const Center& center, std::size_t axis,
                              std::vector<Plane>& planes) const {
  planes.clear();
  const Neighbor& bond = center.neighbors[axis];
  for (std::size_t k = 0; k < center.neighbors.size(); ++k) {
    const Neighbor& neighbor = center.neighbors[k];
    if (k == axis || neighbor.f_dihedral.value == 0.0) continue;
    const double cosine = std::clamp(bond.direction.dot(neighbor.direction), -1.0, 1.0);
    const ValueAndSlope bent = cubic_rise(cosine, straight_angle);
    const Eigen::Vector3d normal = bond.separation.cross(neighbor.separation);
    const double square = normal.squaredNorm();
    const double sides = bond.r * neighbor.r;
    constexpr double smallest_sine = 1e-9;  // three atoms on a line span no plane
    if (bent.value == 0.0 || square < smallest_sine * smallest_sine * sides * sides) continue;
    planes.push_back(
        {k, normal, 1.0 / square, neighbor.f_dihedral.value * bent.value, cosine, bent});
  }
}

// Returns D; weight is the derivative of the energy with respect to it.
double GeneralAtom::add_dihedral(std::size_t j, std::size_t back, double weight) {
  find_planes(near_, j, near_planes_);
  find_planes(far_, back, far_planes_);
  double sum = 0.0;
  for (const Plane& near : near_planes_) {
    Neighbor& neighbor = near_.neighbors[near.neighbor];
    double slope_share = 0.0;
    Eigen::Vector3d slope_normal = Eigen::Vector3d::Zero();
    for (const Plane& far : far_planes_) {
      const Neighbor& other = far_.neighbors[far.neighbor];
      // The third atom of a three-membered ring is on both ends: no dihedral angle. Images of one
      // atom are far from each other compared with rounding.
      if (other.atom == neighbor.atom) {
        const Eigen::Vector3d between =
            near_.neighbors[j].separation + other.separation - neighbor.separation;
        constexpr double rounding = 1e-6;
        if (between.norm() < rounding * neighbor.r) continue;
      }
      const double overlap = near.normal.dot(far.normal);
      const double over = overlap * near.inverse_square;
      const double squared_sine = 1.0 - overlap * over * far.inverse_square;
      sum += near.share * far.share * squared_sine;
      slope_share += far.share * squared_sine;
      slope_normal -= 2.0 * near.share * far.share * over * far.inverse_square *
                      (far.normal - over * near.normal);
    }
    near_.neighbors[j].slope += weight * neighbor.separation.cross(slope_normal);
    neighbor.slope += weight * slope_normal.cross(near_.neighbors[j].separation);
    neighbor.slope +=
        weight * slope_share * near.bent.value * neighbor.f_dihedral.slope * neighbor.direction;
    if (near.bent.slope == 0.0) continue;
    add_slope_of_cosine(j, near.neighbor, near.cosine,
                        weight * slope_share * neighbor.f_dihedral.value * near.bent.slope);
  }
  return sum;
}

void GeneralAtom::clear_links() const {
  const Candidates& c = in_.candidates;
  const std::size_t first = c.first[near_.atom] - out_.first_link;
  const std::size_t end = c.first[near_.atom + 1] - out_.first_link;
  std::fill(out_.links + 4 * first, out_.links + 4 * end, 0.0);
}

// Adds to what the links have; what is kept for irregular neighbors is the atom's own business.
void GeneralAtom::write() {
  const Candidates& c = in_.candidates;
  for (std::uint32_t link = c.first[near_.atom]; link < c.first[near_.atom + 1]; ++link) {
    out_.cutoffs[link] = 0.0;
    out_.others[link] = 0.0;
  }
  for (std::size_t k = 0; k < near_.neighbors.size(); ++k) {
    const Neighbor& neighbor = near_.neighbors[k];
    const std::size_t link = neighbor.link - out_.first_link;
    Eigen::Vector3d::Map(out_.links + 4 * link) += neighbor.slope;
    out_.links[4 * link + 3] += due_[k];
    virial_ -= neighbor.slope * neighbor.separation.transpose();
    out_.cutoffs[neighbor.link] = neighbor.slope_f;
    out_.others[neighbor.link] = neighbor.slope_X;
  }
  out_.energies[near_.atom - out_.first_atom] += energy_;
  out_.coordination[near_.atom] = slope_coordination_;
}

}  // namespace trivalent::potentials::rebo_detail
