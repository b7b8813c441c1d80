#include "rebo/evaluator.h"

#include <algorithm>
#include <atomic>

#include "parallel.h"
#include "validation.h"

namespace trivalent::potentials::rebo_detail {

namespace {

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

}  // namespace

Evaluator::Evaluator(const Parameters& parameters, double skin, RegularKernel kernel)
    : parameters_(parameters),
      regular_parameters_(regular_parameters(parameters)),
      regular_kernel_(kernel),
      skin_(skin) {}

void Evaluator::evaluate(const AtomsView& atoms, EnergyForces& result) {
  result.energies.resize(atoms.size());
  result.forces.resize(atoms.size());
  const bool is_current = known_ && is_same_system(atoms) && evaluate_tiles(atoms, result);
  if (!is_current) {
    start(atoms);
    (void)evaluate_tiles(atoms, result);  // nothing has moved since
  }
  const std::size_t tiles = known_->candidates.tile_count();
  for_each_part(tiles, [&](std::size_t t) { known_->sums.add_crossings(t, result); });
  // Only irregular atoms have bonds whose cutoff has a slope.
  for_each_part(tiles, [&](std::size_t t) { known_->irregular_tiles.add_coordination_slopes(t); });
  auto totals = sum_over_parts<Totals>(tiles, [&](std::size_t t) {
    return known_->irregular_tiles.add_forces_of_cutoffs(t, result);
  });
  for (const Totals& of_tile : totals_) totals += of_tile;
  result.energy = totals.energy;
  // Only the sum over all atoms is symmetric, since two atoms share the terms of a bond.
  result.virial = totals.virial.selfadjointView<Eigen::Upper>();
}

// All that atoms do to their links; false if one has moved too far for that.
bool Evaluator::evaluate_tiles(const AtomsView& atoms, EnergyForces& result) {
  return evaluate_regular_tiles(atoms, result) && evaluate_irregular_tiles(atoms, result);
}

// Tiles that turn out not to be regular are evaluated as irregular from now on.
bool Evaluator::evaluate_regular_tiles(const AtomsView& atoms, EnergyForces& result) {
  std::atomic<bool> has_moved = false;
  for_each_part(known_->candidates.tile_count(), [&](std::size_t tile) {
    if (is_irregular_[tile] != 0) return;
    Workspace& workspace = workspaces_.local();
    const RegularTiles::Task task = {.atoms = atoms,
                                     .tile = tile,
                                     .max_moved = 0.5 * skin_,
                                     .parameters = regular_parameters_,
                                     .kernel = regular_kernel_};
    switch (known_->regular_tiles.evaluate(task, workspace.tile, workspace.slopes)) {
      case RegularTiles::Outcome::moved:
        has_moved = true;
        break;
      case RegularTiles::Outcome::not_regular:
        is_irregular_[tile] = 1;
        break;
      case RegularTiles::Outcome::evaluated:
        totals_[tile] = known_->sums.set_tile(tile, workspace.slopes, result);
    }
  });
  return !has_moved;
}

bool Evaluator::evaluate_irregular_tiles(const AtomsView& atoms, EnergyForces& result) {
  known_->classifier.clear();
  const auto is_set = [](std::uint8_t flag) { return flag != 0; };
  if (std::ranges::none_of(is_irregular_, is_set)) return true;
  TileFlags evaluated = is_irregular_;
  TileFlags irregular(evaluated.size());
  do {
    evaluated = united(evaluated, irregular);
    // Terms reach two links far, and whether an atom there is regular depends on one link more.
    const TileFlags classified = and_near(and_near(evaluated));
    if (!place(atoms, and_near(classified))) return false;
    known_->classifier.classify(classified);
    irregular = known_->classifier.irregular_tiles();
  } while (united(evaluated, irregular) != evaluated);  // rounding of images: hardly ever
  is_irregular_ = and_near(irregular);
  evaluated = united(evaluated, is_irregular_);
  for_each_part(known_->candidates.tile_count(), [&](std::size_t tile) {
    if (evaluated[tile] == 0) return;
    Workspace& workspace = workspaces_.local();
    known_->irregular_tiles.evaluate(tile, workspace.regular, workspace.slopes);
    totals_[tile] = known_->sums.set_tile(tile, workspace.slopes, result);
  });
  return true;
}

TileFlags Evaluator::and_near(const TileFlags& tiles) const {
  TileFlags result(tiles.size());
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    if (tiles[tile] == 0) continue;
    for (const std::uint32_t near : known_->regular_tiles.patch(tile).near) result[near] = 1;
  }
  return result;
}

bool Evaluator::is_same_system(const AtomsView& atoms) const {
  return atoms.size() == known_->candidates.count() && atoms.species.size() == atoms.size() &&
         atoms.box.periodic == box_.periodic && atoms.box.cell == box_.cell;
}

void Evaluator::start(const AtomsView& atoms) {
  require_valid(atoms, "rebo");
  known_.reset();
  known_ = std::make_unique<Known>(*this, atoms);
  box_ = atoms.box;
  is_irregular_.assign(known_->candidates.tile_count(), 0);
  totals_.assign(known_->candidates.tile_count(), {});
}

Evaluator::Known::Known(const Evaluator& evaluator, const AtomsView& atoms_then)
    : candidates(atoms_then, evaluator.skin_),
      regular_tiles(atoms_then, candidates,
                    evaluator.parameters_.bond(Species::carbon, Species::carbon).cutoff),
      atoms(candidates, atoms_then.box),
      classifier(evaluator.parameters_, candidates, atoms),
      irregular_tiles({.parameters = evaluator.parameters_,
                       .regular_parameters = evaluator.regular_parameters_,
                       .kernel = evaluator.regular_kernel_,
                       .candidates = candidates,
                       .atoms = atoms,
                       .classifier = classifier}),
      sums(candidates) {}

// Copies the positions of some tiles, and of the images of their atoms; false if an atom has moved
// too far.
bool Evaluator::place(const AtomsView& atoms, const TileFlags& tiles) {
  std::atomic<bool> has_moved = false;
  for_each_part(tiles.size(), [&](std::size_t tile) {
    if (tiles[tile] == 0) return;
    if (known_->regular_tiles.squared_way(atoms, tile) > 0.25 * skin_ * skin_) has_moved = true;
    known_->atoms.place_tile(atoms, tile);
  });
  known_->atoms.place_images(tiles);
  return !has_moved;
}

}  // namespace trivalent::potentials::rebo_detail
