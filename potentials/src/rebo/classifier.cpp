#include "rebo/classifier.h"

#include <algorithm>
#include <atomic>

#include "parallel.h"
#include "rebo/cutoff.h"
#include "rebo/regular_atom.h"
#include "validation.h"

namespace trivalent::potentials::rebo_detail {

void Classifier::clear() {
  for (std::vector<std::uint32_t>& irregular : irregular_) irregular.clear();
}

TileFlags Classifier::irregular_tiles() const {
  TileFlags result(irregular_.size());
  for (std::size_t tile = 0; tile < result.size(); ++tile) result[tile] = !irregular_[tile].empty();
  return result;
}

void Classifier::classify(const TileFlags& tiles) {
  for_each_part(tiles.size(), [&](std::size_t tile) {
    if (tiles[tile] != 0) classify_tile(tile);
  });
  for_each_part(tiles.size(), [&](std::size_t tile) {
    for (const std::uint32_t atom : irregular_[tile]) mark_around(atom);
  });
}

void Classifier::classify_tile(std::size_t tile) {
  irregular_[tile].clear();
  const Surroundings in = atoms_.surroundings(parameters_);
  for (std::uint32_t i = candidates_.tiles[tile]; i < candidates_.tiles[tile + 1]; ++i) {
    atoms_.states[i] = 0;
    if (is_regular(i, in)) continue;
    atoms_.states[i] = atom_state::irregular | atom_state::unconjugated;
    irregular_[tile].push_back(i);
    count_neighbors(i, in);
  }
}

// Sets the bonds of regular atoms.
bool Classifier::is_regular(std::uint32_t atom, const Surroundings& in) {
  const Candidates& c = candidates_;
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
  if (bonds) atoms_.bonded[atom] = *bonds;
  return bonds.has_value();
}

void Classifier::count_neighbors(std::uint32_t atom, const Surroundings& in) {
  const Candidates& c = candidates_;
  Coordination sum;
  for (std::uint32_t link = c.first[atom]; link < c.first[atom + 1]; ++link) {
    const std::uint32_t other = c.home(c.point[link]);
    const double r = in.separation(atom, link).norm();
    if (r <= 0.0) throw_coincident("rebo", c.order[atom], c.order[other]);
    const Species species = c.species[other];
    sum.of(species) += cosine_switch(r, parameters_.bond(c.species[atom], species).cutoff).value;
  }
  atoms_.coordinations[atom] = sum;
}

// An irregular atom makes the bonds of its neighbors other than conjugated and, if it has more than
// three neighbors, those of their neighbors.
void Classifier::mark_around(std::uint32_t irregular) {
  const Candidates& c = candidates_;
  const bool is_crowded = atoms_.coordinations[irregular].total() > 3.0;
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
void Classifier::mark(std::uint32_t atom, std::uint8_t state) {
  std::atomic_ref known(atoms_.states[atom]);
  if ((known.load(std::memory_order_relaxed) & state) != 0) return;
  known.fetch_or(state, std::memory_order_relaxed);
}

}  // namespace trivalent::potentials::rebo_detail
