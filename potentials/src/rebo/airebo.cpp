#include "trivalent/potentials/airebo.h"

#include <cmath>

#include "cell_grid.h"
#include "parallel.h"
#include "rebo/bond_list.h"
#include "rebo/bond_order.h"
#include "rebo/cutoff.h"
#include "rebo/evaluator.h"
#include "rebo/far_pairs.h"
#include "rebo/gradient.h"
#include "rebo/screening.h"
#include "totals.h"
#include "trivalent/potentials/neighbor_list.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

using namespace rebo_detail;  // NOLINT(google-build-using-namespace): the parts of this potential

// Once a pair, not once from each end.
[[nodiscard]] bool is_first_of_pair(std::uint32_t from, std::uint32_t to,
                                    const std::array<std::int32_t, 3>& image) {
  return to != from ? to > from : image > std::array<std::int32_t, 3>{0, 0, 0};
}

void add_pair(EnergyForces& result, std::uint32_t i, std::uint32_t j, double energy) {
  result.energy += energy;
  result.energies[i] += 0.5 * energy;
  result.energies[j] += 0.5 * energy;
}

// What differs from the Lennard-Jones energies of FarPairs: pairs that may become bonds, and pairs
// that bonds connect.
class NearPairs {
 public:
  NearPairs(const AtomsView& atoms, const BondList& bonds, Gradient& gradient, EnergyForces& result)
      : atoms_(atoms), bonds_(bonds), gradient_(gradient), result_(result), paths_(bonds) {}

  /// Goes on to the pairs of another atom, and takes from those that bonds connect what FarPairs
  /// adds.
  void start_from(std::uint32_t atom) {
    paths_.start_from(atom);
    for (const Path& path : paths_.all()) {
      if (is_first_of_pair(atom, path.atom, path.image)) take_from_far_pair(atom, path);
    }
  }

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

  void take_from_far_pair(std::uint32_t atom, const Path& path) {
    const ImagePair pair = {.first = atom, .second = path.atom, .image = path.image};
    const Eigen::Vector3d separation =
        atoms_.box.shifted(atoms_.positions[path.atom] - atoms_.positions[atom], path.image);
    const double r2 = separation.squaredNorm();
    if (is_nearer(atoms_, pair, {r2, far_from * far_from})) return;
    const ValueAndSlope energy =
        lennard_jones_energy(r2, nonbonded(bonds_.species(atom), bonds_.species(path.atom)));
    add_pair(result_, atom, path.atom, -path.strength * energy.value);
    gradient_.add_separation(atom, path.atom, separation,
                             -2.0 * path.strength * energy.slope * separation);
    add_slopes_of_path(path, -energy.value);
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

  const AtomsView& atoms_;
  const BondList& bonds_;
  Gradient& gradient_;
  EnergyForces& result_;
  Paths paths_;
};

// Part of the atoms' share in a result.
struct Share : EnergyForces {
  Share& operator+=(const Share& other) {
    energy += other.energy;
    virial += other.virial;
    for (std::size_t i = 0; i < energies.size(); ++i) {
      energies[i] += other.energies[i];
      forces[i] += other.forces[i];
    }
    return *this;
  }
};

// Adds up what body(begin, end, share) makes of the parts of [0, n). Every part has arrays of its
// own for all atoms, therefore they are few; on any number of threads they are the same.
template <typename Body>
void add_shares(std::size_t n, EnergyForces& result, const Body& body) {
  constexpr std::size_t n_parts = 4;
  std::vector<Share> shares(n_parts);
  for_each_part(n_parts, [&](std::size_t part) {
    set_zero(shares[part], result.energies.size());
    body(part * n / n_parts, (part + 1) * n / n_parts, shares[part]);
  });
  for (std::size_t part = 1; part < n_parts; ++part) shares[0] += shares[part];
  result.energy += shares[0].energy;
  result.virial += shares[0].virial;
  for_each_chunk(result.energies.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      result.energies[i] += shares[0].energies[i];
      result.forces[i] += shares[0].forces[i];
    }
  });
}

void add_near_pairs(const AtomsView& atoms, const BondList& bonds, EnergyForces& result) {
  const CellGrid grid(atoms, far_from * rounding_margin);
  add_shares(grid.points().size(), result, [&](std::size_t begin, std::size_t end, Share& share) {
    Gradient gradient(bonds, share);
    NearPairs pairs(atoms, bonds, gradient, share);
    for (std::size_t p = begin; p < end; ++p) {
      const GridPoint& from = grid.points()[p];
      if (!from.is_home) continue;
      pairs.start_from(from.atom);
      grid.for_each_neighbor(
          p, p + 1, [&](std::size_t, std::size_t q, const Eigen::Vector3d& separation, double r2) {
            const GridPoint& to = grid.points()[q];
            const auto image = image_between(from, to);
            if (!is_first_of_pair(from.atom, to.atom, image)) return;
            if (!is_nearer(atoms, from, to, {r2, far_from * far_from})) return;
            pairs.add_pair_with(from.atom, {to.atom, image, separation, std::sqrt(r2)});
          });
    }
    gradient.finish();
  });
}

void add_torsion(const BondList& bonds, EnergyForces& result) {
  add_shares(bonds.size(), result, [&](std::size_t begin, std::size_t end, Share& share) {
    Gradient gradient(bonds, share);
    const BondOrder orders(bonds, stuart_2000, &gradient);
    for (std::size_t b = begin; b < end; ++b) {
      const DirectedBond& bond = bonds[b];
      if (bond.reverse < b) continue;  // once a bond, not once a direction
      if (bonds.species(bond.from) != Species::carbon) continue;
      if (bonds.species(bond.to) != Species::carbon) continue;
      const double sum = orders.torsion_sum(pair_of(bonds, b), bond.cutoff.value, share.energies);
      gradient.add_cutoff(b, sum);
      share.energy += sum * bond.cutoff.value;
    }
    gradient.finish();
  });
}

}  // namespace

EnergyForces airebo(const AtomsView& atoms, const AireboOptions& options) {
  return Airebo(options).evaluate(atoms);
}

struct Airebo::State {
  static constexpr double skin = 0.3;  // [Å] of the neighbors that may be bonded
  Evaluator bonded{stuart_2000, skin};
  FarPairs far_pairs;
};

Airebo::Airebo(const AireboOptions& options)
    : options_(options), state_(std::make_unique<State>()) {}

Airebo::~Airebo() = default;

void Airebo::forget() { state_ = std::make_unique<State>(); }

void Airebo::compute(const AtomsView& atoms, EnergyForces& result) {
  require_valid(atoms, "airebo");
  state_->bonded.evaluate(atoms, result);
  if (!options_.lennard_jones && !options_.torsion) return;
  const BondList bonds(atoms, stuart_2000);
  if (options_.lennard_jones) {
    add_near_pairs(atoms, bonds, result);
    state_->far_pairs.add(atoms, result);
  }
  if (options_.torsion) add_torsion(bonds, result);
}

}  // namespace trivalent::potentials
