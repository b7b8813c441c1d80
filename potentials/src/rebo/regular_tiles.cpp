#include "rebo/regular_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "parallel.h"
#include "rebo/regular_atom.h"

namespace trivalent::potentials::rebo_detail {

RegularTiles::RegularTiles(const AtomsView& atoms, const Candidates& candidates,
                           const Range& cutoff)
    : candidates_(candidates), cutoff_(cutoff), box_(atoms.box) {
  start_.resize(atoms.size());
  for_each_chunk(atoms.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) start_[i] = atoms.positions[candidates.order[i]];
  });
  patches_.resize(candidates.tile_count());
  for_each_part(patches_.size(), [&](std::size_t t) { patches_[t] = Patch(candidates, t); });
}

double RegularTiles::squared_way(const AtomsView& atoms, std::size_t tile) const {
  double largest = 0.0;
  for (std::uint32_t i = candidates_.tiles[tile]; i < candidates_.tiles[tile + 1]; ++i) {
    // The caller's order may jump about in memory.
    constexpr std::uint32_t ahead = 16;
    if (i + ahead < candidates_.count()) {
      __builtin_prefetch(&atoms.positions[candidates_.order[i + ahead]]);
    }
    const std::uint32_t given = candidates_.order[i];
    const double squared_way = (atoms.positions[given] - start_[i]).squaredNorm();
    const bool is_followed =
        std::isfinite(squared_way) && atoms.species[given] == candidates_.species[i];
    if (!is_followed) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, squared_way);
  }
  return largest;
}

RegularTiles::Outcome RegularTiles::evaluate(const Task& task, Workspace& workspace,
                                             TileSlopes& slopes) const {
  if (squared_way(task.atoms, task.tile) > task.max_moved * task.max_moved) {
    return Outcome::moved;
  }
  if (!patches_[task.tile].is_usable) return Outcome::not_regular;
  place(task.atoms, task.tile, workspace);
  unpack(task.tile, workspace);
  if (!find_bonds(workspace)) return Outcome::not_regular;
  run_kernel(task, workspace, slopes);
  return Outcome::evaluated;
}

void RegularTiles::place(const AtomsView& atoms, std::size_t tile, Workspace& workspace) const {
  const Candidates& c = candidates_;
  const std::vector<Patch::Outside>& outside = patches_[tile].outside;
  workspace.positions.resize(4 * (c.tiles[tile + 1] - c.tiles[tile] + outside.size()));
  double* next = workspace.positions.data();
  const auto put = [&](std::uint32_t index, const Patch::Shift& shift) {
    Eigen::Vector3d x = atoms.positions[index];
    const bool is_shifted = (shift[0] | shift[1] | shift[2]) != 0;
    if (is_shifted) x += box_.cell * Eigen::Vector3d(shift[0], shift[1], shift[2]);
    Eigen::Vector3d::Map(next) = x;
    next += 4;
  };
  for (std::uint32_t i = c.tiles[tile]; i < c.tiles[tile + 1]; ++i) {
    put(c.order[i], c.wraps.empty() ? Patch::Shift{} : c.wraps[i]);
  }
  for (const Patch::Outside& point : outside) put(point.index, point.shift);
}

void RegularTiles::unpack(std::size_t tile, Workspace& workspace) const {
  const Candidates& c = candidates_;
  const Patch& patch = patches_[tile];
  const std::uint32_t begin = c.tiles[tile];
  const std::uint32_t count = c.tiles[tile + 1] - begin;
  workspace.first.clear();
  for (std::uint32_t i = 0; i <= count; ++i) {
    workspace.first.push_back(c.first[begin + i] - c.first[begin]);
  }
  for (const std::uint16_t links : patch.ring) {
    workspace.first.push_back(workspace.first.back() + links);
  }
  workspace.point.assign(patch.point.begin(), patch.point.end());
  workspace.reverse.assign(patch.reverse.begin(), patch.reverse.end());
  workspace.states.assign(workspace.first.size() - 1, 0);
  workspace.bonded.resize(workspace.first.size() - 1);
  workspace.atoms.resize(count);
  std::iota(workspace.atoms.begin(), workspace.atoms.end(), 0);
}

bool RegularTiles::find_bonds(Workspace& workspace) const {
  const auto position = [&](std::size_t point) {
    return Eigen::Vector3d::Map(&workspace.positions[4 * point]);
  };
  for (std::size_t i = 0; i < workspace.bonded.size(); ++i) {
    const std::uint32_t* const ends = &workspace.point[workspace.first[i]];
    const auto bonds = regular_bonds(
        cutoff_, workspace.first[i + 1] - workspace.first[i],
        [&](std::size_t k) -> Eigen::Vector3d { return position(ends[k]) - position(i); },
        [](std::size_t) { return true; });
    if (!bonds) return false;
    workspace.bonded[i] = *bonds;
  }
  return true;
}

// Beyond some ten thousand atoms everything comes from memory: what the next tile reads is asked
// for part by part while this one is evaluated.
void RegularTiles::prefetch_next(const Task& task, Part part) const {
  const std::size_t next = task.tile + 1;
  if (next == candidates_.tile_count()) return;
  const std::uint32_t begin = candidates_.tiles[next];
  const std::uint32_t count = candidates_.tiles[next + 1] - begin;
  const Patch& patch = patches_[next];
  for (const std::uint32_t index : part.of(std::span(candidates_.order).subspan(begin, count))) {
    __builtin_prefetch(&task.atoms.positions[index]);
  }
  for (const Patch::Outside& point : part.of(std::span(patch.outside))) {
    __builtin_prefetch(&task.atoms.positions[point.index]);
  }
  prefetch(part.of(std::span(start_).subspan(begin, count)));
  prefetch(part.of(std::span(patch.point)));
  prefetch(part.of(std::span(patch.reverse)));
}

void RegularTiles::run_kernel(const Task& task, const Workspace& workspace,
                              TileSlopes& slopes) const {
  slopes.clear(workspace.atoms.size(), workspace.reverse.size());
  const RegularArguments arguments = {.parameters = &task.parameters,
                                      .positions = workspace.positions.data(),
                                      .first = workspace.first.data(),
                                      .point = workspace.point.data(),
                                      .reverse = workspace.reverse.data(),
                                      .bonded = workspace.bonded.data(),
                                      .states = workspace.states.data(),
                                      .homes = nullptr,
                                      .atom_count = std::numeric_limits<std::uint32_t>::max(),
                                      .slopes = slopes.links.data(),
                                      .energies = slopes.energies.data(),
                                      .first_link = 0,
                                      .first_atom = 0};
  std::array<double, 6> virial{};
  const std::span<const std::uint32_t> atoms(workspace.atoms);
  constexpr std::size_t batch = 16;  // a multiple of all kernels'
  const std::size_t batches = (atoms.size() + batch - 1) / batch;
  for (std::size_t k = 0; k < batches; ++k) {
    prefetch_next(task, {k, batches});
    const auto some = atoms.subspan(k * batch, std::min(batch, atoms.size() - k * batch));
    task.kernel(arguments, some.data(), some.size(), virial.data());
  }
  slopes.virial = upper_half(virial);
}

}  // namespace trivalent::potentials::rebo_detail
