#include "trivalent/potentials/airebo.h"

#include <cmath>

#include "cell_grid.h"
#include "parallel.h"
#include "rebo/bond_list.h"
#include "rebo/bond_order.h"
#include "rebo/cutoff.h"
#include "rebo/evaluator.h"
#include "rebo/gradient.h"
#include "rebo/screening.h"
#include "totals.h"
#include "trivalent/potentials/neighbor_list.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

using namespace rebo_detail;  // NOLINT(google-build-using-namespace): the parts of this potential

[[nodiscard]] const NonbondedParameters& nonbonded(Species a, Species b) {
  return nonbonded_2000[static_cast<std::size_t>(a) + static_cast<std::size_t>(b)];
}

// 4ε[(σ/r)^12 - (σ/r)^6], switched off smoothly before 3σ; with its slope in r², which needs no
// root of it.
[[nodiscard]] inline ValueAndSlope lennard_jones_energy(double r2, const NonbondedParameters& p) {
  const double inverse = 1.0 / r2;
  const double second = p.sigma * p.sigma * inverse;
  const double sixth = second * second * second;
  const ValueAndSlope full = {4.0 * p.epsilon * sixth * (sixth - 1.0),
                              -12.0 * p.epsilon * sixth * (2.0 * sixth - 1.0) * inverse};
  const Range end = {nonbonded_end.begin * p.sigma, nonbonded_end.end * p.sigma};
  if (r2 <= end.begin * end.begin) return full;
  const double r = std::sqrt(r2);
  const ValueAndSlope rise = cubic_rise(r, end);
  return {full.value * (1.0 - rise.value),
          full.slope * (1.0 - rise.value) - full.value * 0.5 * r * inverse * rise.slope};
}

void add_pair(EnergyForces& result, std::uint32_t i, std::uint32_t j, double energy) {
  result.energy += energy;
  result.energies[i] += 0.5 * energy;
  result.energies[j] += 0.5 * energy;
}

// Pairs too far apart for any path of bonds: Lennard-Jones and nothing else.
void add_far_pairs(const Atoms& atoms, EnergyForces& result) {
  const CellGrid grid(atoms, nonbonded_end.end * nonbonded_2000[0].sigma);
  constexpr double nearest = longest_path * longest_path;
  const auto sum_chunk = [&](std::size_t begin, std::size_t end) {
    Totals sum;
    grid.for_each_neighbor(
        begin, end,
        [&](std::size_t p, std::size_t q, const Eigen::Vector3d& separation, double r2) {
          if (r2 * rounding_margin * rounding_margin < nearest) return;
          const GridPoint& from = grid.points()[p];
          const GridPoint& to = grid.points()[q];
          if (is_nearer(atoms, from, to, {r2, nearest})) return;
          const ValueAndSlope pair =
              lennard_jones_energy(r2, nonbonded(atoms.species[from.atom], atoms.species[to.atom]));
          const Eigen::Vector3d force = 2.0 * pair.slope * separation;
          result.energies[from.atom] += 0.5 * pair.value;
          result.forces[from.atom] += force;
          sum.energy += 0.5 * pair.value;
          sum.virial -= 0.5 * force * separation.transpose();
        });
    return sum;
  };
  const auto totals = sum_over_chunks<Totals>(grid.points().size(), sum_chunk);
  result.energy += totals.energy;
  result.virial += totals.virial;
}

// Pairs that bonds may connect or that may become bonds themselves.
class NearPairs {
 public:
  NearPairs(const BondList& bonds, Gradient& gradient, EnergyForces& result)
      : bonds_(bonds), gradient_(gradient), result_(result), paths_(bonds) {}

  /// Goes on to the pairs of another atom.
  void start_from(std::uint32_t atom) { paths_.start_from(atom); }

  void add_pair_with(std::uint32_t atom, const Neighbor& neighbor) {
    const Path* path = paths_.to(neighbor.atom, neighbor.image);
    const double strength = path == nullptr ? 0.0 : path->strength;
    if (strength >= 1.0) return;
    const Species a = bonds_.species(atom);
    const Species b = bonds_.species(neighbor.atom);
    const Pair pair = {.from = atom,
                       .to = neighbor.atom,
                       .image = neighbor.image,
                       .separation = neighbor.separation,
                       .distance = neighbor.distance,
                       .as_if = stuart_2000.bond(a, b).cutoff.begin,
                       .bond = bond_between(atom, neighbor)};
    const ValueAndSlope energy =
        lennard_jones_energy(pair.distance * pair.distance, nonbonded(a, b));
    const Approach approached = approach(pair, nonbonded(a, b));
    const double free = 1.0 - strength;
    add_pair(result_, atom, neighbor.atom, free * energy.value * approached.share);

    const double slope_over_distance =
        free * (2.0 * energy.slope * approached.share +
                energy.value * approached.slope_distance / pair.distance);
    gradient_.add_separation(pair.from, pair.to, pair.separation,
                             slope_over_distance * pair.separation);
    const double slope_order = free * energy.value * approached.slope_bond_order;
    if (slope_order != 0.0) {
      (void)BondOrder(bonds_, stuart_2000, &gradient_).bond_order(pair, slope_order);
    }
    if (path != nullptr) add_slopes_of_path(*path, -energy.value * approached.share);
  }

 private:
  // How much of the energy is there by the bond order the two would have, [Stuart2000, eq. 9].
  struct Approach {
    double share;
    double slope_distance;
    double slope_bond_order;
  };

  [[nodiscard]] Approach approach(const Pair& pair, const NonbondedParameters& p) const {
    const ValueAndSlope far = cubic_rise(pair.distance, p.approach);
    if (far.value == 1.0) return {1.0, 0.0, 0.0};
    const double order = BondOrder(bonds_, stuart_2000, nullptr).bond_order(pair, 0.0);
    const ValueAndSlope bonded = cubic_rise(order, p.bond_order);
    // S(t_r) S(t_b) + 1 - S(t_r) with S = 1 - rise.
    return {1.0 - (1.0 - far.value) * bonded.value, far.slope * bonded.value,
            -(1.0 - far.value) * bonded.slope};
  }

  void add_slopes_of_path(const Path& path, double weight) {
    for (std::size_t k = 0; k < path.length; ++k) {
      const std::size_t bond = path.bonds[k];
      gradient_.add_cutoff(bond, weight * path.strength / bonds_[bond].cutoff.value);
    }
  }

  [[nodiscard]] std::optional<std::size_t> bond_between(std::uint32_t atom,
                                                        const Neighbor& neighbor) const {
    for (const std::size_t b : bonds_.from(atom)) {
      if (bonds_[b].to == neighbor.atom && bonds_[b].image == neighbor.image) return b;
    }
    return std::nullopt;
  }

  const BondList& bonds_;
  Gradient& gradient_;
  EnergyForces& result_;
  Paths paths_;
};

// Once a pair, not once from each end.
[[nodiscard]] bool is_first_of_pair(const GridPoint& from, const GridPoint& to) {
  if (to.atom != from.atom) return to.atom > from.atom;
  return image_between(from, to) > std::array<std::int32_t, 3>{0, 0, 0};
}

void add_near_pairs(const Atoms& atoms, const BondList& bonds, EnergyForces& result) {
  Gradient gradient(bonds, result);
  NearPairs pairs(bonds, gradient, result);
  const CellGrid grid(atoms, longest_path * rounding_margin);
  std::optional<std::size_t> center;
  grid.for_each_neighbor(
      0, grid.points().size(),
      [&](std::size_t p, std::size_t q, const Eigen::Vector3d& separation, double r2) {
        const GridPoint& from = grid.points()[p];
        const GridPoint& to = grid.points()[q];
        if (!is_first_of_pair(from, to)) return;
        if (!is_nearer(atoms, from, to, {r2, longest_path * longest_path})) return;
        if (center != p) pairs.start_from(from.atom);
        center = p;
        pairs.add_pair_with(from.atom,
                            {to.atom, image_between(from, to), separation, std::sqrt(r2)});
      });
  gradient.finish();
}

void add_torsion(const BondList& bonds, EnergyForces& result) {
  Gradient gradient(bonds, result);
  const BondOrder orders(bonds, stuart_2000, &gradient);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const DirectedBond& bond = bonds[b];
    if (bond.reverse < b) continue;  // once a bond, not once a direction
    if (bonds.species(bond.from) != Species::carbon) continue;
    if (bonds.species(bond.to) != Species::carbon) continue;
    const double sum = orders.torsion_sum(pair_of(bonds, b), bond.cutoff.value, result.energies);
    gradient.add_cutoff(b, sum);
    result.energy += sum * bond.cutoff.value;
  }
  gradient.finish();
}

}  // namespace

EnergyForces airebo(const Atoms& atoms, const AireboOptions& options) {
  return Airebo(options).evaluate(atoms);
}

void Airebo::compute(const Atoms& atoms, EnergyForces& result) {
  require_valid(atoms, "airebo");
  constexpr double no_skin = 0.0;  // neighbors are used once
  Evaluator(stuart_2000, no_skin).evaluate(atoms, result);
  if (!options_.lennard_jones && !options_.torsion) return;
  const BondList bonds(atoms, stuart_2000);
  if (options_.lennard_jones) {
    add_near_pairs(atoms, bonds, result);
    add_far_pairs(atoms, result);
  }
  if (options_.torsion) add_torsion(bonds, result);
}

}  // namespace trivalent::potentials
