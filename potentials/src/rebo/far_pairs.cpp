#include "rebo/far_pairs.h"

#include <algorithm>
#include <cmath>

#include "parallel.h"

namespace trivalent::potentials::rebo_detail {

namespace {

constexpr double skin = 1.0;                       // [Å]
constexpr double reach = nonbonded_end.end * 3.4;  // σ of carbon, the longest of all [Å]

bool is_same_box(const Box& a, const Box& b) {
  return a.periodic == b.periodic && a.cell == b.cell && a.origin == b.origin;
}

}  // namespace

const NonbondedParameters& nonbonded(Species a, Species b) {
  return nonbonded_2000[static_cast<std::size_t>(a) + static_cast<std::size_t>(b)];
}

bool FarPairs::is_current(const AtomsView& atoms) const {
  if (!std::ranges::equal(at_.species, atoms.species) || !is_same_box(at_.box, atoms.box)) {
    return false;
  }
  constexpr double farthest = 0.5 * skin;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const double moved = (atoms.positions[i] - at_.positions[i]).squaredNorm();
    if (!(moved < farthest * farthest)) return false;
  }
  return true;
}

void FarPairs::find_neighbors(const AtomsView& atoms) {
  const CellGrid grid(atoms, reach + skin);
  points_.clear();
  species_.clear();
  centers_.clear();
  for (const GridPoint& point : grid.points()) {
    if (point.is_home) centers_.push_back(static_cast<std::uint32_t>(points_.size()));
    species_.push_back(atoms.species[point.atom]);
    points_.push_back({point.atom, {point.image[0], point.image[1], point.image[2]}});
  }
  // From a chunk of points come the neighbors of its centers, in order.
  std::vector<std::vector<std::uint32_t>> parts(chunk_count(points_.size()));
  std::vector<std::size_t> counts(points_.size(), 0);
  for_each_chunk(points_.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& part = parts[begin / chunk_size];
    grid.for_each_neighbor(begin, end, [&](std::size_t p, std::size_t q, const auto&, double) {
      part.push_back(static_cast<std::uint32_t>(q));
      ++counts[p];
    });
  });
  first_.assign(1, 0);
  for (const std::uint32_t center : centers_) first_.push_back(first_.back() + counts[center]);
  others_.clear();
  others_.reserve(first_.back());
  for (std::vector<std::uint32_t>& part : parts) {
    others_.insert(others_.end(), part.begin(), part.end());
    std::vector<std::uint32_t>().swap(part);
  }
  at_.positions.assign(atoms.positions.begin(), atoms.positions.end());
  at_.species.assign(atoms.species.begin(), atoms.species.end());
  at_.box = atoms.box;
}

ImagePair FarPairs::pair_of(const Point& from, const Point& to) {
  ImagePair pair = {.first = from.atom, .second = to.atom, .image = to.image};
  for (std::size_t k = 0; k < 3; ++k) pair.image[k] -= from.image[k];
  return pair;
}

void FarPairs::find_separations(std::size_t center, const AtomsView& atoms,
                                Separations& found) const {
  constexpr double begin = far_from * far_from;
  constexpr double unclear = begin * rounding_margin * rounding_margin;
  constexpr double end = reach * reach;
  const Point& from = points_[centers_[center]];
  const Eigen::Vector3d here = places_[centers_[center]];
  found.count = 0;
  for (std::size_t k = first_[center]; k < first_[center + 1]; ++k) {
    const std::uint32_t q = others_[k];
    const Eigen::Vector3d separation = places_[q] - here;
    const double r2 = separation.squaredNorm();
    found.set(separation, r2, species_[q]);
    bool is_far = r2 < end && r2 * rounding_margin * rounding_margin >= begin;
    if (is_far && r2 < unclear) {
      is_far = !is_nearer(atoms, pair_of(from, points_[q]), {r2, begin});
    }
    found.count += is_far ? 1 : 0;
  }
}

void FarPairs::Separations::evaluate(Species center) {
  const auto of_carbon = [&](std::size_t k) { return species[k] == Species::carbon; };
  const NonbondedParameters with_carbon = nonbonded(center, Species::carbon);
  // A loop of one set of parameters over plain arrays is vectorized.
  const double* from = squared.data();
  double* value = values.data();
  double* slope = slopes.data();
  for (std::size_t k = 0, n = count; k < n; ++k) {
    const ValueAndSlope pair = lennard_jones_energy(from[k], with_carbon);
    value[k] = pair.value;
    slope[k] = pair.slope;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (of_carbon(k)) continue;
    const ValueAndSlope pair = lennard_jones_energy(squared[k], nonbonded(center, species[k]));
    values[k] = pair.value;
    slopes[k] = pair.slope;
  }
}

Totals FarPairs::add_of(std::size_t center, const AtomsView& atoms, Separations& pairs,
                        EnergyForces& result) const {
  pairs.make_room(first_[center + 1] - first_[center]);
  find_separations(center, atoms, pairs);
  const std::uint32_t atom = points_[centers_[center]].atom;
  pairs.evaluate(atoms.species[atom]);
  double energy = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();  // its lower half
  const auto& [x, y, z] = pairs.along;
  for (std::size_t k = 0; k < pairs.count; ++k) {
    energy += 0.5 * pairs.values[k];
    const double slope = pairs.slopes[k];  // half of dE/dr times 1/r
    const Eigen::Vector3d pull = slope * Eigen::Vector3d(x[k], y[k], z[k]);
    force += 2.0 * pull;
    virial(0, 0) -= pull.x() * x[k];
    virial(1, 0) -= pull.x() * y[k];
    virial(2, 0) -= pull.x() * z[k];
    virial(1, 1) -= pull.y() * y[k];
    virial(2, 1) -= pull.y() * z[k];
    virial(2, 2) -= pull.z() * z[k];
  }
  result.energies[atom] += energy;
  result.forces[atom] += force;
  return {.energy = energy, .virial = virial.selfadjointView<Eigen::Lower>()};
}

void FarPairs::add(const AtomsView& atoms, EnergyForces& result) {
  if (!is_current(atoms)) find_neighbors(atoms);
  places_.resize(points_.size());
  for_each_chunk(points_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      places_[p] = atoms.box.shifted(atoms.positions[points_[p].atom], points_[p].image);
    }
  });
  const auto totals =
      sum_over_chunks<Totals>(centers_.size(), [&](std::size_t begin, std::size_t end) {
        Totals sum;
        Separations pairs;
        for (std::size_t center = begin; center < end; ++center) {
          sum += add_of(center, atoms, pairs, result);
        }
        return sum;
      });
  result.energy += totals.energy;
  result.virial += totals.virial;
}

}  // namespace trivalent::potentials::rebo_detail
