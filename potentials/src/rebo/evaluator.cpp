#include "rebo/evaluator.h"

#include <atomic>
#include <cmath>
#include <utility>

#include "parallel.h"
#include "rebo/cutoff.h"
#include "rebo/prefetch.h"
#include "rebo/regular_atom.h"
#include "validation.h"

namespace trivalent::potentials::rebo_detail {

namespace {

constexpr std::uint32_t results_ahead = 32;  // atoms between asking for a result's place and use

[[nodiscard]] RegularParameters regular_parameters(const Parameters& parameters) {
  const BondParameters& bond = parameters.bond(Species::carbon, Species::carbon);
  RegularParameters result{};
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

// Tiles that are in one or the other.
[[nodiscard]] std::vector<std::uint8_t> united(std::vector<std::uint8_t> tiles,
                                               const std::vector<std::uint8_t>& others) {
  for (std::size_t tile = 0; tile < others.size(); ++tile) tiles[tile] |= others[tile];
  return tiles;
}

}  // namespace

Evaluator::Evaluator(const Parameters& parameters, double skin, RegularKernel kernel)
    : parameters_(parameters),
      regular_parameters_(regular_parameters(parameters)),
      regular_kernel_(kernel),
      skin_(skin) {}

void Evaluator::evaluate(const Atoms& atoms, EnergyForces& result) {
  result_ = &result;
  result.energies.resize(atoms.size());
  result.forces.resize(atoms.size());
  const bool is_current = candidates_ && is_same_system(atoms) && evaluate_tiles(atoms);
  if (!is_current) {
    start(atoms);
    (void)evaluate_tiles(atoms);  // nothing has moved since
  }
  const std::size_t tiles = candidates_->tile_count();
  for_each_part(tiles, [&](std::size_t t) { import_crossings(t); });
  // Only irregular atoms have bonds whose cutoff has a slope.
  for_each_part(tiles, [&](std::size_t t) { add_coordination_slopes_of_neighbors(t); });
  auto totals =
      sum_over_parts<Totals>(tiles, [&](std::size_t t) { return add_forces_of_cutoffs(t); });
  for (const Totals& of_tile : totals_) totals += of_tile;
  result.energy = totals.energy;
  // Only the sum over all atoms is symmetric, since two atoms share the terms of a bond.
  result.virial = totals.virial.selfadjointView<Eigen::Upper>();
}

// All that atoms do to their links; false if one has moved too far for that.
bool Evaluator::evaluate_tiles(const Atoms& atoms) {
  return evaluate_regular_tiles(atoms) && evaluate_irregular_tiles(atoms);
}

// Tiles that turn out not to be regular are evaluated as irregular from now on.
bool Evaluator::evaluate_regular_tiles(const Atoms& atoms) {
  std::atomic<bool> has_moved = false;
  for_each_part(candidates_->tile_count(), [&](std::size_t tile) {
    if (is_irregular_[tile] != 0) return;
    Workspace& workspace = workspaces_.local();
    const RegularTiles::Task task = {.atoms = atoms,
                                     .tile = tile,
                                     .max_moved = 0.5 * skin_,
                                     .parameters = regular_parameters_,
                                     .kernel = regular_kernel_};
    switch (regular_tiles_->evaluate(task, workspace.tile, workspace.slopes)) {
      case RegularTiles::Outcome::moved:
        has_moved = true;
        break;
      case RegularTiles::Outcome::not_regular:
        is_irregular_[tile] = 1;
        break;
      case RegularTiles::Outcome::evaluated:
        totals_[tile] = gather(tile, workspace.slopes);
        export_crossings(tile, workspace.slopes);
    }
  });
  return !has_moved;
}

bool Evaluator::evaluate_irregular_tiles(const Atoms& atoms) {
  for (std::vector<std::uint32_t>& irregular : irregular_) irregular.clear();
  const auto is_set = [](std::uint8_t flag) { return flag != 0; };
  if (std::ranges::none_of(is_irregular_, is_set)) return true;
  TileFlags evaluated = is_irregular_;
  TileFlags irregular(evaluated.size());
  do {
    evaluated = united(evaluated, irregular);
    // Terms reach two links far, and whether an atom there is regular depends on one link more.
    const TileFlags classified = and_near(and_near(evaluated));
    if (!place(atoms, and_near(classified))) return false;
    classify(classified);
    irregular = irregular_tiles();
  } while (united(evaluated, irregular) != evaluated);  // rounding of images: hardly ever
  is_irregular_ = and_near(irregular);
  evaluated = united(evaluated, is_irregular_);
  for_each_part(candidates_->tile_count(), [&](std::size_t tile) {
    if (evaluated[tile] != 0) totals_[tile] = evaluate_tile(tile);
  });
  return true;
}

Evaluator::TileFlags Evaluator::and_near(const TileFlags& tiles) const {
  TileFlags result(tiles.size());
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    if (tiles[tile] == 0) continue;
    for (const std::uint32_t near : regular_tiles_->patch(tile).near) result[near] = 1;
  }
  return result;
}

Evaluator::TileFlags Evaluator::irregular_tiles() const {
  TileFlags result(irregular_.size());
  for (std::size_t tile = 0; tile < result.size(); ++tile) result[tile] = !irregular_[tile].empty();
  return result;
}

bool Evaluator::is_same_system(const Atoms& atoms) const {
  return atoms.size() == candidates_->count() && atoms.species.size() == atoms.size() &&
         atoms.box.periodic == box_.periodic && atoms.box.cell == box_.cell;
}

void Evaluator::start(const Atoms& atoms) {
  require_valid(atoms, "rebo");
  regular_tiles_.reset();
  candidates_.reset();
  candidates_.emplace(atoms, skin_);
  regular_tiles_.emplace(atoms, *candidates_,
                         parameters_.bond(Species::carbon, Species::carbon).cutoff);
  box_ = atoms.box;
  image_homes_.clear();
  for (const Candidates::Image& image : candidates_->images) image_homes_.push_back(image.home);

  const std::size_t n = atoms.size();
  const std::size_t links = candidates_->point.size();
  const std::size_t tiles = candidates_->tile_count();
  is_irregular_.assign(tiles, 0);
  totals_.assign(tiles, {});
  irregular_.assign(tiles, {});
  positions_ = without_values<double>(4 * candidates_->point_count());
  states_ = without_values<std::uint8_t>(n);
  std::fill_n(states_.get(), n, std::uint8_t{0});
  bonded_ = without_values<std::uint32_t>(n);
  coordinations_ = without_values<Coordination>(n);
  exports_ = without_values<Eigen::Vector4d>(candidates_->crossings.size());
  cutoff_slopes_ = without_values<double>(links);
  other_slopes_ = without_values<double>(links);
  coordination_slopes_ = without_values<Coordination>(n);
}

// Copies the positions of some tiles, and of the images of their atoms; false if an atom has moved
// too far.
bool Evaluator::place(const Atoms& atoms, const TileFlags& tiles) {
  const Candidates& c = *candidates_;
  std::atomic<bool> has_moved = false;
  for_each_part(tiles.size(), [&](std::size_t tile) {
    if (tiles[tile] == 0) return;
    if (regular_tiles_->squared_way(atoms, tile) > 0.25 * skin_ * skin_) has_moved = true;
    for (std::uint32_t i = c.tiles[tile]; i < c.tiles[tile + 1]; ++i) {
      Eigen::Vector3d x = atoms.positions[c.order[i]];
      if (!c.wraps.empty()) {
        const auto& wrap = c.wraps[i];
        x += box_.cell * Eigen::Vector3d(wrap[0], wrap[1], wrap[2]);
      }
      Eigen::Vector3d::Map(&positions_[std::size_t{4} * i]) = x;
    }
  });
  place_images(tiles);
  return !has_moved;
}

void Evaluator::place_images(const TileFlags& tiles) {
  const Candidates& c = *candidates_;
  for_each_chunk(c.images.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto& [home, shift] = c.images[k];
      if (tiles[c.tile_of(home)] == 0) continue;
      const Eigen::Vector3d x = Eigen::Vector3d::Map(&positions_[std::size_t{4} * home]);
      Eigen::Vector3d::Map(&positions_[4 * (c.count() + k)]) = box_.shifted(x, shift);
    }
  });
}

Eigen::Vector3d Evaluator::separation(std::uint32_t atom, std::uint32_t link) const {
  return surroundings().separation(atom, link);
}

void Evaluator::classify(const TileFlags& tiles) {
  for_each_part(tiles.size(), [&](std::size_t tile) {
    if (tiles[tile] != 0) classify_tile(tile);
  });
  for_each_part(tiles.size(), [&](std::size_t tile) {
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

// Sets bonded_ of regular atoms.
bool Evaluator::is_regular(std::uint32_t atom, const Surroundings& in) {
  const Candidates& c = *candidates_;
  if (c.species[atom] != Species::carbon) return false;
  const std::uint32_t first = c.first[atom];
  const std::uint32_t* const ends = &c.point[first];
  const auto count = static_cast<std::uint32_t>(c.count());
  const Eigen::Vector3d center = in.position(atom);
  const auto bonds = regular_bonds(
      parameters_.bond(Species::carbon, Species::carbon).cutoff, c.first[atom + 1] - first,
      [&](std::uint32_t k) -> Eigen::Vector3d {
        return ends[k] < count ? in.position(ends[k]) - center : in.separation(atom, first + k);
      },
      [&](std::uint32_t k) { return c.species[c.home(ends[k])] == Species::carbon; });
  if (bonds) bonded_[atom] = *bonds;
  return bonds.has_value();
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

RegularArguments Evaluator::regular_arguments(std::size_t tile, TileSlopes& slopes) const {
  const Candidates& c = *candidates_;
  return {.parameters = &regular_parameters_,
          .positions = positions_.get(),
          .first = c.first.data(),
          .point = c.point.data(),
          .reverse = c.reverse.data(),
          .bonded = bonded_.get(),
          .states = states_.get(),
          .homes = image_homes_.data(),
          .atom_count = static_cast<std::uint32_t>(c.count()),
          .slopes = slopes.links.data(),
          .energies = slopes.energies.data(),
          .first_link = c.first[c.tiles[tile]],
          .first_atom = c.tiles[tile]};
}

Slopes Evaluator::irregular_slopes(std::size_t tile, TileSlopes& slopes) const {
  return {.links = slopes.links.data(),
          .energies = slopes.energies.data(),
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
  Workspace& workspace = workspaces_.local();
  const std::uint32_t begin = c.tiles[tile];
  const std::uint32_t end = c.tiles[tile + 1];
  workspace.slopes.clear(end - begin, c.first[end] - c.first[begin]);
  evaluate_regular(tile, workspace);
  evaluate_irregular(tile, workspace.slopes);
  const Totals totals = gather(tile, workspace.slopes);
  export_crossings(tile, workspace.slopes);
  return totals;
}

// Asks for what the next tile reads, part by part while this one is evaluated.
void Evaluator::prefetch_next(std::size_t tile, Part part) const {
  const Candidates& c = *candidates_;
  if (tile + 1 == c.tile_count()) return;
  const std::uint32_t begin = c.tiles[tile + 1];
  const std::uint32_t count = c.tiles[tile + 2] - begin;
  const std::uint32_t first_link = c.first[begin];
  const std::uint32_t links = c.first[begin + count] - first_link;
  prefetch(part.of(
      std::span<const double>(&positions_[std::size_t{4} * begin], std::size_t{4} * count)));
  prefetch(part.of(std::span(c.first).subspan(begin, count)));
  prefetch(part.of(std::span(c.point).subspan(first_link, links)));
  prefetch(part.of(std::span(c.reverse).subspan(first_link, links)));
  prefetch(part.of(std::span<const std::uint32_t>(&bonded_[begin], count)));
}

void Evaluator::evaluate_regular(std::size_t tile, Workspace& workspace) const {
  workspace.regular.clear();
  for (std::uint32_t i = candidates_->tiles[tile]; i < candidates_->tiles[tile + 1]; ++i) {
    if ((states_[i] & atom_state::irregular) == 0) workspace.regular.push_back(i);
  }
  std::array<double, 6> virial{};
  const RegularArguments arguments = regular_arguments(tile, workspace.slopes);
  const std::span<const std::uint32_t> regular = workspace.regular;
  constexpr std::size_t batch = 16;  // a multiple of all kernels'
  const std::size_t batches = (regular.size() + batch - 1) / batch;
  for (std::size_t k = 0; k < batches; ++k) {
    prefetch_next(tile, {k, batches});
    const auto some = regular.subspan(k * batch, std::min(batch, regular.size() - k * batch));
    regular_kernel_(arguments, some.data(), some.size(), virial.data());
  }
  workspace.slopes.virial += upper_half(virial);
}

// After the regular ones, to some of which it adds.
void Evaluator::evaluate_irregular(std::size_t tile, TileSlopes& slopes) const {
  IrregularAtom irregular_atom(surroundings(), irregular_slopes(tile, slopes),
                               candidates_->tiles[tile + 1] - candidates_->tiles[tile]);
  for (std::uint32_t i = candidates_->tiles[tile]; i < candidates_->tiles[tile + 1]; ++i) {
    if ((states_[i] & atom_state::irregular) != 0) {
      irregular_atom.evaluate(i);
    } else if ((states_[i] & atom_state::has_other_pi) != 0) {
      irregular_atom.add_other_pi(i);
    }
  }
  slopes.virial += irregular_atom.virial();
}

// The caller's order may jump about in memory.
void Evaluator::prefetch_result(std::size_t atom) const {
  const Candidates& c = *candidates_;
  if (atom >= c.count()) return;
  __builtin_prefetch(&result_->forces[c.order[atom]]);
  __builtin_prefetch(&result_->energies[c.order[atom]]);
}

// Forces and energies from the links within the tile; returns the energy, which needs no others.
Totals Evaluator::gather(std::size_t tile, const TileSlopes& slopes) {
  const Candidates& c = *candidates_;
  const std::uint32_t begin = c.tiles[tile];
  const std::uint32_t first_link = c.first[begin];
  const std::uint32_t links = c.first[c.tiles[tile + 1]] - first_link;
  const auto slope = [&](std::uint32_t link) {
    return Eigen::Vector4d::Map(&slopes.links[std::size_t{4} * link]);
  };
  Totals totals;
  totals.virial = slopes.virial;
  for (std::uint32_t i = begin; i < c.tiles[tile + 1]; ++i) {
    prefetch_result(i + results_ahead);
    Eigen::Vector4d own = Eigen::Vector4d::Zero();
    Eigen::Vector4d other = Eigen::Vector4d::Zero();
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      own += slope(link - first_link);
      const std::uint32_t back = c.reverse[link] - first_link;  // wraps around if before the tile
      if (back < links) other += slope(back);
    }
    const double energy = slopes.energies[i - begin];
    result_->energies[c.order[i]] = energy + other[3];
    result_->forces[c.order[i]] = (own - other).head<3>();
    totals.energy += energy + own[3];
  }
  return totals;
}

void Evaluator::export_crossings(std::size_t tile, const TileSlopes& slopes) {
  const Candidates& c = *candidates_;
  const std::uint32_t first_link = c.first[c.tiles[tile]];
  for (std::uint32_t k = c.first_crossing[tile]; k < c.first_crossing[tile + 1]; ++k) {
    const std::size_t link = c.crossings[k].link - first_link;
    exports_[k] = Eigen::Vector4d::Map(&slopes.links[4 * link]);
  }
}

void Evaluator::import_crossings(std::size_t tile) {
  const Candidates& c = *candidates_;
  for (std::uint32_t k = c.first_crossing[tile]; k < c.first_crossing[tile + 1]; ++k) {
    const auto& [atom, link, back] = c.crossings[k];
    result_->forces[c.order[atom]] -= exports_[back].head<3>();
    result_->energies[c.order[atom]] += exports_[back][3];
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
      result_->forces[c.order[i]] += (from_here + from_there) * along;
      totals.virial -= from_here * along * bond.transpose();
    }
  }
  return totals;
}

}  // namespace trivalent::potentials::rebo_detail
