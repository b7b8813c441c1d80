#include "rebo/irregular_tiles.h"

#include <algorithm>
#include <array>
#include <span>

#include "rebo/cutoff.h"
#include "rebo/irregular_atom.h"

namespace trivalent::potentials::rebo_detail {

IrregularTiles::IrregularTiles(const Inputs& inputs)
    : in_(inputs),
      cutoff_slopes_(without_values<double>(inputs.candidates.point.size())),
      other_slopes_(without_values<double>(inputs.candidates.point.size())),
      coordination_slopes_(without_values<Coordination>(inputs.candidates.count())) {}

RegularArguments IrregularTiles::regular_arguments(std::size_t tile, TileSlopes& slopes) const {
  const Candidates& c = in_.candidates;
  return {.parameters = &in_.regular_parameters,
          .positions = in_.atoms.positions.get(),
          .first = c.first.data(),
          .point = c.point.data(),
          .reverse = c.reverse.data(),
          .bonded = in_.atoms.bonded.get(),
          .states = in_.atoms.states.get(),
          .homes = in_.atoms.image_homes.data(),
          .atom_count = static_cast<std::uint32_t>(c.count()),
          .slopes = slopes.links.data(),
          .energies = slopes.energies.data(),
          .first_link = c.first[c.tiles[tile]],
          .first_atom = c.tiles[tile]};
}

Slopes IrregularTiles::irregular_slopes(std::size_t tile, TileSlopes& slopes) const {
  return {.links = slopes.links.data(),
          .energies = slopes.energies.data(),
          .first_link = in_.candidates.first[in_.candidates.tiles[tile]],
          .first_atom = in_.candidates.tiles[tile],
          .cutoffs = cutoff_slopes_.get(),
          .others = other_slopes_.get(),
          .coordination = coordination_slopes_.get()};
}

void IrregularTiles::evaluate(std::size_t tile, std::vector<std::uint32_t>& regular,
                              TileSlopes& slopes) {
  const Candidates& c = in_.candidates;
  const std::uint32_t begin = c.tiles[tile];
  const std::uint32_t end = c.tiles[tile + 1];
  slopes.clear(end - begin, c.first[end] - c.first[begin]);
  evaluate_regular(tile, regular, slopes);
  evaluate_irregular(tile, slopes);
}

// Asks for what the next tile reads, part by part while this one is evaluated.
void IrregularTiles::prefetch_next(std::size_t tile, Part part) const {
  const Candidates& c = in_.candidates;
  if (tile + 1 == c.tile_count()) return;
  const std::uint32_t begin = c.tiles[tile + 1];
  const std::uint32_t count = c.tiles[tile + 2] - begin;
  const std::uint32_t first_link = c.first[begin];
  const std::uint32_t links = c.first[begin + count] - first_link;
  prefetch(part.of(std::span<const double>(&in_.atoms.positions[std::size_t{4} * begin],
                                           std::size_t{4} * count)));
  prefetch(part.of(std::span(c.first).subspan(begin, count)));
  prefetch(part.of(std::span(c.point).subspan(first_link, links)));
  prefetch(part.of(std::span(c.reverse).subspan(first_link, links)));
  prefetch(part.of(std::span<const std::uint32_t>(&in_.atoms.bonded[begin], count)));
}

void IrregularTiles::evaluate_regular(std::size_t tile, std::vector<std::uint32_t>& regular,
                                      TileSlopes& slopes) const {
  regular.clear();
  for (std::uint32_t i = in_.candidates.tiles[tile]; i < in_.candidates.tiles[tile + 1]; ++i) {
    if ((in_.atoms.states[i] & atom_state::irregular) == 0) regular.push_back(i);
  }
  std::array<double, 6> virial{};
  const RegularArguments arguments = regular_arguments(tile, slopes);
  constexpr std::size_t batch = 16;  // a multiple of all kernels'
  const std::size_t batches = (regular.size() + batch - 1) / batch;
  for (std::size_t k = 0; k < batches; ++k) {
    prefetch_next(tile, {k, batches});
    const auto some =
        std::span(regular).subspan(k * batch, std::min(batch, regular.size() - k * batch));
    in_.kernel(arguments, some.data(), some.size(), virial.data());
  }
  slopes.virial += upper_half(virial);
}

// After the regular ones, to some of which it adds.
void IrregularTiles::evaluate_irregular(std::size_t tile, TileSlopes& slopes) const {
  IrregularAtom irregular_atom(in_.atoms.surroundings(in_.parameters),
                               irregular_slopes(tile, slopes),
                               in_.candidates.tiles[tile + 1] - in_.candidates.tiles[tile]);
  for (std::uint32_t i = in_.candidates.tiles[tile]; i < in_.candidates.tiles[tile + 1]; ++i) {
    if ((in_.atoms.states[i] & atom_state::irregular) != 0) {
      irregular_atom.evaluate(i);
    } else if ((in_.atoms.states[i] & atom_state::has_other_pi) != 0) {
      irregular_atom.add_other_pi(i);
    }
  }
  slopes.virial += irregular_atom.virial();
}

// All neighbors of an irregular atom have other π and have written their share.
void IrregularTiles::add_coordination_slopes(std::size_t tile) {
  const Candidates& c = in_.candidates;
  for (const std::uint32_t i : in_.classifier.irregular(tile)) {
    double sum = 0.0;
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      sum += other_slopes_[c.reverse[link]];
    }
    coordination_slopes_[i].carbon += sum;
    coordination_slopes_[i].hydrogen += sum;
  }
}

// Both ends of a bond within its switching range are irregular: each adds its force on itself.
Totals IrregularTiles::add_forces_of_cutoffs(std::size_t tile, EnergyForces& result) const {
  const Candidates& c = in_.candidates;
  const Surroundings in = in_.atoms.surroundings(in_.parameters);
  Totals totals;
  for (const std::uint32_t i : in_.classifier.irregular(tile)) {
    for (std::uint32_t link = c.first[i]; link < c.first[i + 1]; ++link) {
      const std::uint32_t other = c.home(c.point[link]);
      const Eigen::Vector3d bond = in.separation(i, link);
      const double r = bond.norm();
      const Range cutoff = in_.parameters.bond(c.species[i], c.species[other]).cutoff;
      if (r <= cutoff.begin || r >= cutoff.end) continue;
      const double from_here = cutoff_slopes_[link] + coordination_slopes_[i].of(c.species[other]);
      const double from_there =
          cutoff_slopes_[c.reverse[link]] + coordination_slopes_[other].of(c.species[i]);
      const Eigen::Vector3d along = cosine_switch(r, cutoff).slope / r * bond;
      result.forces[c.order[i]] += (from_here + from_there) * along;
      totals.virial -= from_here * along * bond.transpose();
    }
  }
  return totals;
}

}  // namespace trivalent::potentials::rebo_detail
