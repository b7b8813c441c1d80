#include "rebo/evaluator.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "parallel.h"
#include "rebo/cutoff.h"
#include "validation.h"

namespace trivalent::potentials::rebo_detail {

namespace {

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

struct Largest {
  double value = 0.0;
  Largest& operator+=(const Largest& other) {
    // Not std::max, which loses a NaN.
    if (!(other.value <= value)) value = other.value;
    return *this;
  }
};

}  // namespace

Evaluator::Evaluator(const Parameters& parameters, double skin)
    : parameters_(parameters),
      clean_parameters_(clean_parameters(parameters)),
      clean_kernel_(best_clean_kernel()),
      skin_(skin) {}

const EnergyForces& Evaluator::evaluate(const Atoms& atoms) {
  bool is_current = candidates_ && is_same_system(atoms);
  if (is_current) {
    moved_ += copy_positions(atoms);
    is_current = moved_ <= 0.5 * skin_;  // a NaN among the positions is not <= either
  }
  if (!is_current) start(atoms);
  place_images();
  classify();
  evaluate_terms();
  gather();
  return result_;
}

bool Evaluator::is_same_system(const Atoms& atoms) const {
  return atoms.size() == candidates_->count() && atoms.species.size() == atoms.size() &&
         atoms.box.periodic == box_.periodic && atoms.box.cell == box_.cell;
}

void Evaluator::start(const Atoms& atoms) {
  require_valid(atoms, "rebo");
  // The largest array goes first: searching for neighbors needs room too.
  link_slopes_.reset();
  candidates_.reset();
  candidates_.emplace(atoms, skin_);
  box_ = atoms.box;
  moved_ = 0.0;
  image_homes_.clear();
  for (const Candidates::Image& image : candidates_->images) image_homes_.push_back(image.home);

  const std::size_t n = atoms.size();
  const std::size_t links = candidates_->point.size();
  irregular_.resize(chunk_count(n));
  positions_ = without_values<double>(4 * candidates_->point_count());
  std::fill_n(positions_.get(), 4 * candidates_->point_count(), 0.0);
  states_ = without_values<std::uint8_t>(n);
  bonded_ = without_values<std::uint32_t>(n);
  coordinations_ = without_values<Coordination>(n);
  energies_ = without_values<double>(n);
  link_slopes_ = without_values<double>(4 * links);
  cutoff_slopes_ = without_values<double>(links);
  other_slopes_ = without_values<double>(links);
  coordination_slopes_ = without_values<Coordination>(n);
  result_.energies.resize(n);
  result_.forces.resize(n);
  (void)copy_positions(atoms);
}

// Returns how far the atom that went farthest is from where it was at the last call.
double Evaluator::copy_positions(const Atoms& atoms) {
  const Candidates& c = *candidates_;
  const auto copy_chunk = [&](std::size_t begin, std::size_t end) {
    Largest largest;
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector3d x = atoms.positions[c.order[i]];
      if (!c.wraps.empty()) {
        const auto& wrap = c.wraps[i];
        x += box_.cell * Eigen::Vector3d(wrap[0], wrap[1], wrap[2]);
      }
      auto place = Eigen::Vector3d::Map(&positions_[4 * i]);
      largest += Largest{(x - place).squaredNorm()};
      if (atoms.species[c.order[i]] != c.species[i]) {
        largest += Largest{std::numeric_limits<double>::infinity()};
      }
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
  return Eigen::Vector3d::Map(&positions_[std::size_t{4} * candidates_->point[link]]) -
         Eigen::Vector3d::Map(&positions_[std::size_t{4} * atom]);
}

void Evaluator::classify() {
  const std::size_t n = candidates_->count();
  for_each_chunk(n, [&](std::size_t begin, std::size_t end) {
    classify_chunk(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
                   irregular_[begin / chunk_size]);
  });
  for_each_chunk(n, [&](std::size_t begin, std::size_t) {
    for (const std::uint32_t atom : irregular_[begin / chunk_size]) mark_around(atom);
  });
}

void Evaluator::classify_chunk(std::uint32_t begin, std::uint32_t end,
                               std::vector<std::uint32_t>& irregular) {
  irregular.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    states_[i] = 0;
    if (is_regular(i)) continue;
    states_[i] = atom_state::irregular | atom_state::general;
    irregular.push_back(i);
    count_neighbors(i);
  }
}

// Sets bonded_ of regular atoms: carbons with three carbons at full bonds and nothing in between.
bool Evaluator::is_regular(std::uint32_t atom) {
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
    const Eigen::Vector3d bond = separation(atom, first + offset);
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

// Clean atoms have regular neighbors with neighbors of at most three: so not clean are the
// neighbors of an irregular atom and, if that one has more than three, the neighbors of its
// neighbors.
void Evaluator::mark_around(std::uint32_t irregular) {
  const Candidates& c = *candidates_;
  const bool is_crowded = coordinations_[irregular].total() > 3.0;
  for (std::uint32_t link = c.first[irregular]; link < c.first[irregular + 1]; ++link) {
    const std::uint32_t neighbor = c.home(c.point[link]);
    mark_general(neighbor);
    if (!is_crowded) continue;
    for (std::uint32_t next = c.first[neighbor]; next < c.first[neighbor + 1]; ++next) {
      mark_general(c.home(c.point[next]));
    }
  }
}

// Several threads may mark one atom, all in the same way.
void Evaluator::mark_general(std::uint32_t atom) {
  std::atomic_ref state(states_[atom]);
  if ((state.load(std::memory_order_relaxed) & atom_state::general) != 0) return;
  state.fetch_or(atom_state::general, std::memory_order_relaxed);
}

CleanArguments Evaluator::clean_arguments() const {
  return {.parameters = &clean_parameters_,
          .positions = positions_.get(),
          .first = candidates_->first.data(),
          .point = candidates_->point.data(),
          .reverse = candidates_->reverse.data(),
          .bonded = bonded_.get(),
          .homes = image_homes_.data(),
          .atom_count = static_cast<std::uint32_t>(candidates_->count()),
          .slopes = link_slopes_.get(),
          .energies = energies_.get()};
}

Surroundings Evaluator::surroundings() const {
  return {.parameters = parameters_,
          .candidates = *candidates_,
          .positions = positions_.get(),
          .coordinations = coordinations_.get(),
          .states = states_.get()};
}

Slopes Evaluator::slopes() const {
  return {.links = link_slopes_.get(),
          .energies = energies_.get(),
          .cutoffs = cutoff_slopes_.get(),
          .others = other_slopes_.get(),
          .coordination = coordination_slopes_.get()};
}

void Evaluator::evaluate_terms() {
  const std::size_t n = candidates_->count();
  auto totals = sum_over_chunks<Totals>(n, [&](std::size_t begin, std::size_t end) {
    return evaluate_chunk(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
  });
  // Only irregular atoms have bonds whose cutoff has a slope.
  totals += sum_over_chunks<Totals>(n, [&](std::size_t begin, std::size_t) {
    Totals sum;
    for (const std::uint32_t i : irregular_[begin / chunk_size]) {
      sum.virial += add_slopes_of_cutoffs(i);
    }
    return sum;
  });
  // Only the sum over all atoms is symmetric, since two atoms share the terms of a bond.
  result_.virial = totals.virial.selfadjointView<Eigen::Upper>();
}

Totals Evaluator::evaluate_chunk(std::uint32_t begin, std::uint32_t end) {
  const Candidates& c = *candidates_;
  std::array<std::uint32_t, chunk_size> clean{};
  std::array<std::uint32_t, chunk_size> general{};
  std::size_t clean_count = 0;
  std::size_t general_count = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    if ((states_[i] & atom_state::general) != 0) {
      general[general_count++] = i;
      continue;
    }
    clean[clean_count++] = i;
    if (c.first[i + 1] - c.first[i] == 3) continue;
    std::fill(&link_slopes_[std::size_t{4} * c.first[i]],
              &link_slopes_[std::size_t{4} * c.first[i + 1]], 0.0);
  }
  Totals totals;
  std::array<double, 6> virial{};
  clean_kernel_(clean_arguments(), clean.data(), clean_count, virial.data());
  const auto [xx, yy, zz, xy, xz, yz] = virial;
  totals.virial << xx, xy, xz, 0.0, yy, yz, 0.0, 0.0, zz;
  totals.virial += evaluate_general(std::span(general).first(general_count));
  return totals;
}

Eigen::Matrix3d Evaluator::evaluate_general(std::span<const std::uint32_t> atoms) {
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  GeneralAtom general(surroundings(), slopes());
  for (const std::uint32_t i : atoms) {
    general.evaluate(i);
    for (std::uint32_t link = candidates_->first[i]; link < candidates_->first[i + 1]; ++link) {
      const Eigen::Vector3d slope = Eigen::Vector3d::Map(&link_slopes_[std::size_t{4} * link]);
      virial -= slope * separation(i, link).transpose();
    }
  }
  return virial;
}

// Returns what they add to the virial.
Eigen::Matrix3d Evaluator::add_slopes_of_cutoffs(std::uint32_t atom) {
  const Candidates& c = *candidates_;
  const Species species = c.species[atom];
  double from_neighbors = 0.0;  // all neighbors of an irregular atom are general and have written
  for (std::uint32_t link = c.first[atom]; link < c.first[atom + 1]; ++link) {
    from_neighbors += other_slopes_[c.reverse[link]];
  }
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  for (std::uint32_t link = c.first[atom]; link < c.first[atom + 1]; ++link) {
    const Species other = c.species[c.home(c.point[link])];
    const Eigen::Vector3d bond = separation(atom, link);
    const double r = bond.norm();
    const Range cutoff = parameters_.bond(species, other).cutoff;
    if (r <= cutoff.begin || r >= cutoff.end) continue;
    const double slope =
        cutoff_slopes_[link] + coordination_slopes_[atom].of(other) + from_neighbors;
    const Eigen::Vector3d along = slope * cosine_switch(r, cutoff).slope / r * bond;
    Eigen::Vector3d::Map(&link_slopes_[std::size_t{4} * link]) += along;
    virial -= along * bond.transpose();
  }
  return virial;
}

void Evaluator::gather() {
  const Candidates& c = *candidates_;
  const auto gather_chunk = [&](std::size_t begin, std::size_t end) {
    Totals totals;
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector4d own = Eigen::Vector4d::Zero();
      Eigen::Vector4d other = Eigen::Vector4d::Zero();
      for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
        own += Eigen::Vector4d::Map(&link_slopes_[std::size_t{4} * link]);
        other += Eigen::Vector4d::Map(&link_slopes_[std::size_t{4} * c.reverse[link]]);
      }
      const double energy = energies_[i] + other[3];
      result_.energies[c.order[i]] = energy;
      result_.forces[c.order[i]] = (own - other).head<3>();
      totals.energy += energy;
    }
    return totals;
  };
  result_.energy = sum_over_chunks<Totals>(c.count(), gather_chunk).energy;
}

}  // namespace trivalent::potentials::rebo_detail
