#include "rebo/irregular_atom.h"

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

// Index of the atom's center; those of the tile are loaded once.
std::uint32_t IrregularAtom::find(std::uint32_t atom) {
  const std::uint32_t place = atom - out_.first_atom;  // wraps around if before the tile
  if (place < known_.size() && known_[place] != unknown) return known_[place];
  const auto index = static_cast<std::uint32_t>(centers_.size());
  centers_.push_back(load(atom));
  if (place < known_.size()) known_[place] = index;
  return index;
}

IrregularAtom::Center IrregularAtom::load(std::uint32_t atom) {
  const Candidates& c = in_.candidates;
  Center center = {.atom = atom,
                   .species = c.species[atom],
                   .coordination = in_.coordination(atom),
                   .conjugation = 0.0,
                   .first = static_cast<std::uint32_t>(neighbors_.size()),
                   .count = 0};
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
                         .F = {0.0, 0.0}};
    // The two cutoffs are one function, except between carbon and hydrogen.
    neighbor.f_dihedral = bond.dihedral_cutoff.end == bond.cutoff.end
                              ? neighbor.f
                              : cosine_switch(r, bond.dihedral_cutoff);
    if (neighbor.species == Species::carbon) {
      const double X = in_.coordination(other).total() - neighbor.f.value;
      neighbor.F = cosine_switch(X, conjugation_switch);
      center.conjugation += neighbor.f.value * neighbor.F.value;
    }
    neighbors_.push_back(neighbor);
    ++center.count;
  }
  return center;
}

// Goes on to another atom and loads those of its neighbors that is_needed(neighbor) asks for.
template <typename Condition>
void IrregularAtom::start(std::uint32_t atom, const Condition& is_needed) {
  const std::uint32_t near = find(atom);
  near_ = centers_[near];
  far_.assign(near_.count, unknown);
  for (std::size_t j = 0; j < near_.count; ++j) {
    const Neighbor neighbor = neighbors(near_)[j];  // a copy: loading moves the others
    if (is_needed(neighbor)) far_[j] = find(neighbor.atom);
  }
  near_neighbors_ = neighbors(near_);
  slopes_.assign(near_.count, {});
  energy_ = 0.0;
  slope_coordination_ = {};
}

void IrregularAtom::evaluate(std::uint32_t atom) {
  start(atom, [](const Neighbor&) { return true; });
  find_angles();
  for (std::size_t j = 0; j < near_.count; ++j) evaluate_bond(j);
  add_slopes_of_angles();
  clear_links();
  out_.energies[atom - out_.first_atom] = 0.0;
  write();
}

void IrregularAtom::add_other_pi(std::uint32_t atom) {
  start(atom, [&](const Neighbor& neighbor) {
    const std::uint8_t states = in_.states[atom] | in_.states[neighbor.atom];
    return (states & atom_state::unconjugated) != 0;
  });
  for (std::size_t j = 0; j < near_.count; ++j) {
    if (far_[j] != unknown) evaluate_pi(j);
  }
  write();
}

void IrregularAtom::evaluate_pi(std::size_t j) {
  const Neighbor& bond = near_neighbors_[j];
  const ValueAndSlope attracted =
      attraction(bond.r, bond.f, in_.parameters.bond(near_.species, bond.species));
  const double pi = add_pi(j, -attracted.value);
  energy_ -= 0.5 * attracted.value * pi;
  slopes_[j].separation -= 0.5 * attracted.slope * pi * bond.direction;
}

// The half of the bond's energy that belongs to this atom, and the derivatives it is in charge of.
void IrregularAtom::evaluate_bond(std::size_t j) {
  const Neighbor& bond = near_neighbors_[j];
  const BondParameters& constants = in_.parameters.bond(near_.species, bond.species);
  const ValueAndSlope repelled = repulsion(bond.r, bond.f, constants);
  const ValueAndSlope attracted = attraction(bond.r, bond.f, constants);
  const double sigma = add_sigma(j, attracted.value);
  const double pi = add_pi(j, -attracted.value);
  slopes_[j].due = -0.25 * attracted.value * sigma;
  energy_ += 0.5 * (repelled.value - attracted.value * pi) + slopes_[j].due;
  slopes_[j].separation += 0.5 * (repelled.slope - attracted.slope * (sigma + pi)) * bond.direction;
}

void IrregularAtom::add_coordination_without(std::size_t j, Coordination slope) {
  slope_coordination_.carbon += slope.carbon;
  slope_coordination_.hydrogen += slope.hydrogen;
  slopes_[j].f -= slope.of(near_neighbors_[j].species);
}

void IrregularAtom::add_slope_of_cosine(std::size_t j, std::size_t k, double cosine, double slope) {
  const Neighbor& a = near_neighbors_[j];
  const Neighbor& b = near_neighbors_[k];
  slopes_[j].separation += slope / a.r * (b.direction - cosine * a.direction);
  slopes_[k].separation += slope / b.r * (a.direction - cosine * b.direction);
}

// Every two bonds form one angle, which is in p of both.
void IrregularAtom::find_angles() {
  angles_.clear();
  for (std::size_t k = 1; k < near_.count; ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const double cosine =
          std::clamp(near_neighbors_[j].direction.dot(near_neighbors_[k].direction), -1.0, 1.0);
      angles_.push_back(
          {cosine, angular_shapes(near_.species, cosine, near_.coordination.total()), 0.0});
    }
  }
}

void IrregularAtom::add_slopes_of_angles() {
  for (std::size_t k = 1; k < near_.count; ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const Angle& between = angle(j, k);
      if (between.slope != 0.0) add_slope_of_cosine(j, k, between.cosine, between.slope);
    }
  }
}

// exp λ of an angle at a hydrogen, in p of its bond j.
double IrregularAtom::stretch_factor(std::size_t j, std::size_t k) const {
  if (near_.species == Species::carbon) return 1.0;
  const auto stretch = [&](const Neighbor& n) {
    return n.r - in_.parameters.bond(Species::hydrogen, n.species).preferred_length;
  };
  return std::exp(hydrogen_lambda * (stretch(near_neighbors_[j]) - stretch(near_neighbors_[k])));
}

// Returns p of the bond; half of it weighs -V_A in the energy.
double IrregularAtom::add_sigma(std::size_t j, double attracted) {
  const std::span<const Neighbor> neighbors = near_neighbors_;
  Coordination rest = near_.coordination;
  rest.of(neighbors[j].species) -= neighbors[j].f.value;
  const bool is_carbon = near_.species == Species::carbon;
  const ValueAndSlope few = share_of_few(near_.species, rest.total());
  Value2 P{};
  if (is_carbon) {
    const bool to_carbon = neighbors[j].species == Species::carbon;
    P = (to_carbon ? in_.parameters.p_cc : in_.parameters.p_ch)(rest.carbon, rest.hydrogen);
  }
  double sum = 1.0 + P.value;
  double slope_coordination = 0.0;
  factors_.resize(neighbors.size());
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    if (k == j) continue;
    const AngularValue g = blended(angle(j, k).g, few);
    factors_[k] = stretch_factor(j, k);
    sum += neighbors[k].f.value * g.value * factors_[k];
    slope_coordination += neighbors[k].f.value * g.slope_coordination * factors_[k];
  }
  const double p = 1.0 / std::sqrt(sum);

  const double weight = 0.25 * attracted * p / sum;  // dE/d(sum)
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    if (k == j) continue;
    const AngularValue g = blended(angle(j, k).g, few);
    const Neighbor& neighbor = neighbors[k];
    const double value = weight * g.value * factors_[k];
    slopes_[k].f += value;
    angle(j, k).slope += weight * neighbor.f.value * factors_[k] * g.slope_cosine;
    if (is_carbon) continue;
    const double slope_stretch = value * neighbor.f.value * hydrogen_lambda;
    slopes_[j].separation += slope_stretch * neighbors[j].direction;
    slopes_[k].separation -= slope_stretch * neighbor.direction;
  }
  add_coordination_without(
      j, {weight * (slope_coordination + P.slope_x), weight * (slope_coordination + P.slope_y)});
  return p;
}

// Returns π + T D; weight is the derivative of the energy with respect to it.
double IrregularAtom::add_pi(std::size_t j, double weight) {
  const Neighbor& bond = near_neighbors_[j];
  const Center& far = centers_[far_[j]];
  const std::uint32_t back_link = in_.candidates.reverse[bond.link];
  std::size_t back = 0;
  while (neighbors(far)[back].link != back_link) ++back;
  const Neighbor& opposite = neighbors(far)[back];
  const double N_near = near_.coordination.total() - bond.f.value;
  const double N_far = far.coordination.total() - bond.f.value;
  const double conjugation_near = near_.conjugation - bond.f.value * bond.F.value;
  const double conjugation_far = far.conjugation - opposite.f.value * opposite.F.value;
  const double N_conjugated =
      1.0 + conjugation_near * conjugation_near + conjugation_far * conjugation_far;
  const auto kind =
      static_cast<std::size_t>(near_.species) + static_cast<std::size_t>(bond.species);
  const Value3 pi = pi_splines[kind](N_near, N_far, N_conjugated);

  constexpr std::size_t carbon_carbon = 0;
  const Value3 T = kind == carbon_carbon ? dihedral_spline(N_near, N_far, N_conjugated) : Value3{};
  const bool is_free_to_turn = T.value == 0.0 && T.slope_x == 0.0 && T.slope_z == 0.0;
  const double D = is_free_to_turn ? 0.0 : add_dihedral(j, back, weight * T.value);
  const double slope_near = weight * (pi.slope_x + T.slope_x * D);
  add_coordination_without(j, {slope_near, slope_near});
  const double slope_sum = 2.0 * conjugation_near * weight * (pi.slope_z + T.slope_z * D);
  for (std::size_t k = 0; k < near_.count; ++k) {
    const Neighbor& neighbor = near_neighbors_[k];
    if (k == j || neighbor.species != Species::carbon) continue;
    const double slope_X = slope_sum * neighbor.f.value * neighbor.F.slope;
    slopes_[k].f += slope_sum * neighbor.F.value - slope_X;
    slopes_[k].X += slope_X;
  }
  return pi.value + T.value * D;
}

void IrregularAtom::find_planes(std::span<const Neighbor> neighbors, std::size_t axis,
                                std::vector<Plane>& planes) {
  planes.clear();
  const Neighbor& bond = neighbors[axis];
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    const Neighbor& neighbor = neighbors[k];
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
double IrregularAtom::add_dihedral(std::size_t j, std::size_t back, double weight) {
  const std::span<const Neighbor> far_neighbors = neighbors(centers_[far_[j]]);
  find_planes(near_neighbors_, j, near_planes_);
  find_planes(far_neighbors, back, far_planes_);
  double sum = 0.0;
  for (const Plane& near : near_planes_) {
    const Neighbor& neighbor = near_neighbors_[near.neighbor];
    double slope_share = 0.0;
    Eigen::Vector3d slope_normal = Eigen::Vector3d::Zero();
    for (const Plane& far : far_planes_) {
      const Neighbor& other = far_neighbors[far.neighbor];
      // The third atom of a three-membered ring is on both ends: no dihedral angle. Images of one
      // atom are far from each other compared with rounding.
      if (other.atom == neighbor.atom) {
        const Eigen::Vector3d between =
            near_neighbors_[j].separation + other.separation - neighbor.separation;
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
    slopes_[j].separation += weight * neighbor.separation.cross(slope_normal);
    Eigen::Vector3d& slope_of_neighbor = slopes_[near.neighbor].separation;
    slope_of_neighbor += weight * slope_normal.cross(near_neighbors_[j].separation);
    slope_of_neighbor +=
        weight * slope_share * near.bent.value * neighbor.f_dihedral.slope * neighbor.direction;
    if (near.bent.slope == 0.0) continue;
    add_slope_of_cosine(j, near.neighbor, near.cosine,
                        weight * slope_share * neighbor.f_dihedral.value * near.bent.slope);
  }
  return sum;
}

void IrregularAtom::clear_links() const {
  const Candidates& c = in_.candidates;
  const std::size_t first = c.first[near_.atom] - out_.first_link;
  const std::size_t end = c.first[near_.atom + 1] - out_.first_link;
  std::fill(out_.links + 4 * first, out_.links + 4 * end, 0.0);
}

// Adds to what the links have; what is kept for irregular neighbors is the atom's own business.
void IrregularAtom::write() {
  const Candidates& c = in_.candidates;
  for (std::uint32_t link = c.first[near_.atom]; link < c.first[near_.atom + 1]; ++link) {
    out_.cutoffs[link] = 0.0;
    out_.others[link] = 0.0;
  }
  for (std::size_t k = 0; k < near_.count; ++k) {
    const Neighbor& neighbor = near_neighbors_[k];
    const NeighborSlopes& slopes = slopes_[k];
    const std::size_t link = neighbor.link - out_.first_link;
    Eigen::Vector3d::Map(out_.links + 4 * link) += slopes.separation;
    out_.links[4 * link + 3] += slopes.due;
    virial_ -= slopes.separation * neighbor.separation.transpose();
    out_.cutoffs[neighbor.link] = slopes.f;
    out_.others[neighbor.link] = slopes.X;
  }
  out_.energies[near_.atom - out_.first_atom] += energy_;
  out_.coordination[near_.atom] = slope_coordination_;
}

}  // namespace trivalent::potentials::rebo_detail
