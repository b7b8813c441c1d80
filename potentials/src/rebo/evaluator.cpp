#include "rebo/evaluator.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "parallel.h"
#include "rebo/cutoff.h"
#include "validation.h"

namespace trivalent::potentials::rebo_detail {

namespace {

constexpr std::uint32_t prefetched_atoms = 32;  // at a time; a multiple of all kernels' batches

[[nodiscard]] CleanParameters clean_parameters(const Parameters& parameters) {
  const BondParameters& bond = parameters.bond(Species::carbon, Species::carbon);
  CleanParameters result{};
  result.Q = bond.Q;
  result.A = bond.A;
  result.alpha = bond.alpha;
  std::ranges::copy(bond.B, result.B);
  std::ranges::copy(bond.beta, result.beta);
  for (std::size_t piece = 0; piece < g_carbon_few.size(); ++piece) {
    if (piece + 1 < g_carbon_few.size()) result.knots[piece] = g_carbon_few[piece].end;
    std::ranges::copy(g_carbon_few[piece].c, result.g[piece]);
  }
  // Two other neighbors at both ends, each with two more: N_conj = 1 + 2² + 2².
  result.T = dihedral_spline(2.0, 2.0, 9.0).value;
  result.p_constant = parameters.p_cc(2.0, 0.0).value;
  return result;
}

template <typename T>
[[nodiscard]] std::unique_ptr<T[]> without_values(std::size_t count) {
  return std::unique_ptr<T[]>(new T[count]);  // make_unique would write to all of it
}

// Asks for an array in good time; count may be zero.
template <typename T>
void prefetch(const T* begin, std::size_t count) {
  constexpr std::size_t cache_line = 64;
  const char* bytes = reinterpret_cast<const char*>(begin);
  for (std::size_t k = 0; k < count * sizeof(T); k += cache_line) __builtin_prefetch(bytes + k);
}

struct Largest {
  double value = 0.0;
  Largest& operator+=(const Largest& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

}  // namespace

Evaluator::Evaluator(const Parameters& parameters, double skin, CleanKernel kernel)
    : parameters_(parameters),
      clean_parameters_(clean_parameters(parameters)),
      clean_kernel_(kernel),
      skin_(skin) {}

const EnergyForces& Evaluator::evaluate(const Atoms& atoms) {
  bool is_current = candidates_ && is_same_system(atoms);
  if (is_current) {
    moved_ += copy_positions(atoms);
    is_current = moved_ <= 0.5 * skin_;
  }
  if (!is_current) start(atoms);
  place_images();
  classify();

  const std::size_t tiles = candidates_->tile_count();
  auto totals = sum_over_parts<Totals>(tiles, [&](std::size_t t) { return evaluate_tile(t); });
  for_each_part(tiles, [&](std::size_t t) { import_crossings(t); });
  // Only irregular atoms have bonds whose cutoff has a slope.
  for_each_part(tiles, [&](std::size_t t) { add_coordination_slopes_of_neighbors(t); });
  totals += sum_over_parts<Totals>(tiles, [&](std::size_t t) { return add_forces_of_cutoffs(t); });
  result_.energy = totals.energy;
  // Only the sum over all atoms is symmetric, since two atoms share the terms of a bond.
  result_.virial = totals.virial.selfadjointView<Eigen::Upper>();
  return result_;
}

bool Evaluator::is_same_system(const Atoms& atoms) const {
  return atoms.size() == candidates_->count() && atoms.species.size() == atoms.size() &&
         atoms.box.periodic == box_.periodic && atoms.box.cell == box_.cell;
}

void Evaluator::start(const Atoms& atoms) {
  require_valid(atoms, "rebo");
  candidates_.reset();
  candidates_.emplace(atoms, skin_);
  box_ = atoms.box;
  moved_ = 0.0;
  image_homes_.clear();
  for (const Candidates::Image& image : candidates_->images) image_homes_.push_back(image.home);

  const std::size_t n = atoms.size();
  const std::size_t links = candidates_->point.size();
  irregular_.resize(candidates_->tile_count());
  positions_ = without_values<double>(4 * candidates_->point_count());
  std::fill_n(positions_.get(), 4 * candidates_->point_count(), 0.0);
  states_ = without_values<std::uint8_t>(n);
  bonded_ = without_values<std::uint32_t>(n);
  coordinations_ = without_values<Coordination>(n);
  exports_ = without_values<Eigen::Vector4d>(candidates_->crossings.size());
  cutoff_slopes_ = without_values<double>(links);
  other_slopes_ = without_values<double>(links);
  coordination_slopes_ = without_values<Coordination>(n);
  result_.energies.resize(n);
  result_.forces.resize(n);
  (void)copy_positions(atoms);
}

// Returns how far the atom that went farthest is from where it was at the last call; infinitely far
// if an atom became another element or is nowhere.
double Evaluator::copy_positions(const Atoms& atoms) {
  const Candidates& c = *candidates_;
  const auto copy_chunk = [&](std::size_t begin, std::size_t end) {
    Largest largest;
    for (std::size_t i = begin; i < end; ++i) {
      // The caller's order may jump about in memory.
      if (i + prefetched_atoms < end) prefetch(&atoms.positions[c.order[i + prefetched_atoms]], 1);
      Eigen::Vector3d x = atoms.positions[c.order[i]];
      if (!c.wraps.empty()) {
        const auto& wrap = c.wraps[i];
        x += box_.cell * Eigen::Vector3d(wrap[0], wrap[1], wrap[2]);
      }
      auto place = Eigen::Vector3d::Map(&positions_[4 * i]);
      const double squared_way = (x - place).squaredNorm();
      const bool is_followed =
          std::isfinite(squared_way) && atoms.species[c.order[i]] == c.species[i];
      largest += Largest{is_followed ? squared_way : std::numeric_limits<double>::infinity()};
      place = x;
    }
    return largest;
  };
  return std::sqrt(sum_over_chunks<Largest>(atoms.size(), copy_chunk).value);
}

void Evaluator::place_images() {
  const Candidates& c = *candidates_;
  for_each_chunk(c.images.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto& [home, shift] = c.images[k];
      Eigen::Vector3d x = Eigen::Vector3d::Map(&positions_[std::size_t{4} * home]);
      for (int d = 0; d < 3; ++d) {
        const std::int16_t times = shift[static_cast<std::size_t>(d)];
        if (times != 0) x += times * box_.cell.col(d);
      }
      Eigen::Vector3d::Map(&positions_[4 * (c.count() + k)]) = x;
    }
  });
}

Eigen::Vector3d Evaluator::separation(std::uint32_t atom, std::uint32_t link) const {
  return surroundings().separation(atom, link);
}

void Evaluator::classify() {
  const std::size_t tiles = candidates_->tile_count();
  for_each_part(tiles, [&](std::size_t tile) { classify_tile(tile); });
  for_each_part(tiles, [&](std::size_t tile) {
    for (const std::uint32_t atom : irregular_[tile]) mark_around(atom);
  });
}

void Evaluator::classify_tile(std::size_t tile) {
  irregular_[tile].clear();
  const Surroundings in = surroundings();
  for (std::uint32_t i = candidates_->tiles[tile]; i < candidates_->tiles[tile + 1]; ++i) {
    states_[i] = 0;
    if (is_regular(i, in)) continue;
    states_[i] = atom_state::irregular | atom_state::unconjugated;
    irregular_[tile].push_back(i);
    count_neighbors(i);
  }
}

// Sets bonded_ of regular atoms: carbons with three carbons at full bonds and nothing in between.
bool Evaluator::is_regular(std::uint32_t atom, const Surroundings& in) {
  const Candidates& c = *candidates_;
  const Range cutoff = parameters_.bond(Species::carbon, Species::carbon).cutoff;
  const std::uint32_t first = c.first[atom];
  const std::uint32_t links = c.first[atom + 1] - first;
  constexpr std::uint32_t most_links = 256;  // what eight bits can count
  if (c.species[atom] != Species::carbon || links < 3 || links > most_links) return false;
  std::array<Eigen::Vector3d, 3> bonds;
  std::array<double, 3> squares;
  std::array<std::uint32_t, 3> offsets{};
  std::size_t count = 0;
  for (std::uint32_t offset = 0; offset < links; ++offset) {
    const Eigen::Vector3d bond = in.separation(atom, first + offset);
    const double square = bond.squaredNorm();
    if (square >= cutoff.end * cutoff.end) continue;
    if (count == 3 || square > cutoff.begin * cutoff.begin || square == 0.0) return false;
    if (c.species[c.home(c.point[first + offset])] != Species::carbon) return false;
    bonds[count] = bond;
    squares[count] = square;
    offsets[count++] = offset;
  }
  if (count != 3) return false;
  bonded_[atom] = pack_bonds(offsets[0], offsets[1], offsets[2]);
  // cosθ < -0.995, or three atoms on a line the other way round, without a square root.
  const auto is_straight = [&](std::size_t a, std::size_t b) {
    const double product = bonds[a].dot(bonds[b]);
    constexpr double limit = straight_angle.end * straight_angle.end;
    return product * product > limit * squares[a] * squares[b];
  };
  return !is_straight(0, 1) && !is_straight(0, 2) && !is_straight(1, 2);
}

void Evaluator::count_neighbors(std::uint32_t atom) {
  const Candidates& c = *candidates_;
  Coordination sum;
  for (std::uint32_t link = c.first[atom]; link < c.first[atom + 1]; ++link) {
    const std::uint32_t other = c.home(c.point[link]);
    const double r = separation(atom, link).norm();
    if (r <= 0.0) throw_coincident("rebo", c.order[atom], c.order[other]);
    const Species species = c.species[other];
    sum.of(species) += cosine_switch(r, parameters_.bond(c.species[atom], species).cutoff).value;
  }
  coordinations_[atom] = sum;
}

// An irregular atom makes the bonds of its neighbors other than conjugated and, if it has more than
// three neighbors, those of their neighbors.
void Evaluator::mark_around(std::uint32_t irregular) {
  const Candidates& c = *candidates_;
  const bool is_crowded = coordinations_[irregular].total() > 3.0;
  for (std::uint32_t link = c.first[irregular]; link < c.first[irregular + 1]; ++link) {
    const std::uint32_t neighbor = c.home(c.point[link]);
    mark(neighbor, atom_state::has_other_pi);
    if (!is_crowded) continue;
    mark(neighbor, atom_state::unconjugated);
    for (std::uint32_t next = c.first[neighbor]; next < c.first[neighbor + 1]; ++next) {
      mark(c.home(c.point[next]), atom_state::has_other_pi);
    }
  }
}

// Several threads may mark one atom; the order makes no difference.
void Evaluator::mark(std::uint32_t atom, std::uint8_t state) {
  std::atomic_ref known(states_[atom]);
  if ((known.load(std::memory_order_relaxed) & state) != 0) return;
  known.fetch_or(state, std::memory_order_relaxed);
}

CleanArguments Evaluator::clean_arguments(std::size_t tile, Scratch& scratch) const {
  const Candidates& c = *candidates_;
  return {.parameters = &clean_parameters_,
          .positions = positions_.get(),
          .first = c.first.data(),
          .point = c.point.data(),
          .reverse = c.reverse.data(),
          .bonded = bonded_.get(),
          .states = states_.get(),
          .homes = image_homes_.data(),
          .atom_count = static_cast<std::uint32_t>(c.count()),
          .slopes = scratch.slopes.data(),
          .energies = scratch.energies.data(),
          .first_link = c.first[c.tiles[tile]],
          .first_atom = c.tiles[tile]};
}

Slopes Evaluator::slopes(std::size_t tile, Scratch& scratch) const {
  return {.links = scratch.slopes.data(),
          .energies = scratch.energies.data(),
          .first_link = candidates_->first[candidates_->tiles[tile]],
          .first_atom = candidates_->tiles[tile],
          .cutoffs = cutoff_slopes_.get(),
          .others = other_slopes_.get(),
          .coordination = coordination_slopes_.get()};
}

Surroundings Evaluator::surroundings() const {
  return {.parameters = parameters_,
          .candidates = *candidates_,
          .positions = positions_.get(),
          .coordinations = coordinations_.get(),
          .states = states_.get()};
}

Totals Evaluator::evaluate_tile(std::size_t tile) {
  const Candidates& c = *candidates_;
  Scratch scratch;
  scratch.energies.resize(c.tiles[tile + 1] - c.tiles[tile]);
  scratch.slopes.resize(std::size_t{4} * (c.first[c.tiles[tile + 1]] - c.first[c.tiles[tile]]));
  const Eigen::Matrix3d of_regular = evaluate_regular(tile, scratch);
  const Eigen::Matrix3d of_general = evaluate_general(tile, scratch);
  Totals totals = gather(tile, scratch);
  totals.virial = of_regular + of_general;
  export_crossings(tile, scratch);
  return totals;
}

// Beyond some ten thousand atoms everything comes from memory. It is asked for some atoms at a time
// while others are evaluated: where the results of this tile go, and what the next tile reads.
void Evaluator::prefetch_around(std::size_t tile, std::uint32_t offset) const {
  const Candidates& c = *candidates_;
  const auto atoms = [&](std::size_t t) {
    const std::uint32_t begin = std::min(c.tiles[t] + offset, c.tiles[t + 1]);
    return std::pair(begin, std::min(begin + prefetched_atoms, c.tiles[t + 1]));
  };
  const auto [begin, end] = atoms(tile);
  for (std::uint32_t i = begin; i < end; ++i) {
    prefetch(&result_.forces[c.order[i]], 1);
    prefetch(&result_.energies[c.order[i]], 1);
  }
  if (tile + 1 == c.tile_count()) return;
  const auto [next, next_end] = atoms(tile + 1);
  const std::uint32_t link = c.first[next];
  const std::uint32_t links = c.first[next_end] - link;
  prefetch(&positions_[std::size_t{4} * next], std::size_t{4} * (next_end - next));
  prefetch(&c.first[next], next_end - next);
  prefetch(&c.point[link], links);
  prefetch(&c.reverse[link], links);
  prefetch(&bonded_[next], next_end - next);
  prefetch(&c.order[next], next_end - next);
}

// Returns what they add to the upper half of the virial.
Eigen::Matrix3d Evaluator::evaluate_regular(std::size_t tile, Scratch& scratch) const {
  for (std::uint32_t i = candidates_->tiles[tile]; i < candidates_->tiles[tile + 1]; ++i) {
    if ((states_[i] & atom_state::irregular) == 0) scratch.regular.push_back(i);
  }
  std::array<double, 6> virial{};
  const CleanArguments arguments = clean_arguments(tile, scratch);
  const std::span<const std::uint32_t> regular = scratch.regular;
  for (std::size_t k = 0; k < regular.size(); k += prefetched_atoms) {
    prefetch_around(tile, static_cast<std::uint32_t>(k));
    const auto some =
        regular.subspan(k, std::min<std::size_t>(prefetched_atoms, regular.size() - k));
    clean_kernel_(arguments, some.data(), some.size(), virial.data());
  }
  const auto [xx, yy, zz, xy, xz, yz] = virial;
  Eigen::Matrix3d upper;
  upper << xx, xy, xz, 0.0, yy, yz, 0.0, 0.0, zz;
  return upper;
}

// After the regular ones, to some of which it adds; returns what that adds to the virial.
Eigen::Matrix3d Evaluator::evaluate_general(std::size_t tile, Scratch& scratch) const {
  GeneralAtom general(surroundings(), slopes(tile, scratch),
                      candidates_->tiles[tile + 1] - candidates_->tiles[tile]);
  for (std::uint32_t i = candidates_->tiles[tile]; i < candidates_->tiles[tile + 1]; ++i) {
    if ((states_[i] & atom_state::irregular) != 0) {
      general.evaluate(i);
    } else if ((states_[i] & atom_state::has_other_pi) != 0) {
      general.add_other_pi(i);
    }
  }
  return general.virial();
}

// Forces and energies from the links within the tile; returns the energy, which needs no others.
Totals Evaluator::gather(std::size_t tile, const Scratch& scratch) {
  const Candidates& c = *candidates_;
  const std::uint32_t begin = c.tiles[tile];
  const std::uint32_t first_link = c.first[begin];
  const std::uint32_t links = c.first[c.tiles[tile + 1]] - first_link;
  const auto slope = [&](std::uint32_t link) {
    return Eigen::Vector4d::Map(&scratch.slopes[std::size_t{4} * link]);
  };
  Totals totals;
  for (std::uint32_t i = begin; i < c.tiles[tile + 1]; ++i) {
    Eigen::Vector4d own = Eigen::Vector4d::Zero();
    Eigen::Vector4d other = Eigen::Vector4d::Zero();
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      own += slope(link - first_link);
      const std::uint32_t back = c.reverse[link] - first_link;  // wraps around if before the tile
      if (back < links) other += slope(back);
    }
    const double energy = scratch.energies[i - begin];
    result_.energies[c.order[i]] = energy + other[3];
    result_.forces[c.order[i]] = (own - other).head<3>();
    totals.energy += energy + own[3];
  }
  return totals;
}

void Evaluator::export_crossings(std::size_t tile, const Scratch& scratch) {
  const Candidates& c = *candidates_;
  const std::uint32_t first_link = c.first[c.tiles[tile]];
  for (std::uint32_t k = c.first_crossing[tile]; k < c.first_crossing[tile + 1]; ++k) {
    const std::size_t link = c.crossings[k].link - first_link;
    exports_[k] = Eigen::Vector4d::Map(&scratch.slopes[4 * link]);
  }
}

void Evaluator::import_crossings(std::size_t tile) {
  const Candidates& c = *candidates_;
  for (std::uint32_t k = c.first_crossing[tile]; k < c.first_crossing[tile + 1]; ++k) {
    const auto& [atom, link, back] = c.crossings[k];
    result_.forces[c.order[atom]] -= exports_[back].head<3>();
    result_.energies[c.order[atom]] += exports_[back][3];
  }
}

// All neighbors of an irregular atom have other π and have written their share.
void Evaluator::add_coordination_slopes_of_neighbors(std::size_t tile) {
  const Candidates& c = *candidates_;
  for (const std::uint32_t i : irregular_[tile]) {
    double sum = 0.0;
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      sum += other_slopes_[c.reverse[link]];
    }
    coordination_slopes_[i].carbon += sum;
    coordination_slopes_[i].hydrogen += sum;
  }
}

// Both ends of a bond within its switching range are irregular: each adds its force on itself.
Totals Evaluator::add_forces_of_cutoffs(std::size_t tile) {
  const Candidates& c = *candidates_;
  Totals totals;
  for (const std::uint32_t i : irregular_[tile]) {
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      const std::uint32_t other = c.home(c.point[link]);
      const Eigen::Vector3d bond = separation(i, link);
      const double r = bond.norm();
      const Range cutoff = parameters_.bond(c.species[i], c.species[other]).cutoff;
      if (r <= cutoff.begin || r >= cutoff.end) continue;
      const double from_here = cutoff_slopes_[link] + coordination_slopes_[i].of(c.species[other]);
      const double from_there =
          cutoff_slopes_[c.reverse[link]] + coordination_slopes_[other].of(c.species[i]);
      const Eigen::Vector3d along = cosine_switch(r, cutoff).slope / r * bond;
      result_.forces[c.order[i]] += (from_here + from_there) * along;
      totals.virial -= from_here * along * bond.transpose();
    }
  }
  return totals;
}

}  // namespace trivalent::potentials::rebo_detail
