#include "rebo/candidates.h"

#include <tbb/parallel_sort.h>

#include <limits>

#include "cell_grid.h"
#include "parallel.h"
#include "rebo/parameters.h"
#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials::rebo_detail {

namespace {

using Shift = std::array<std::int16_t, 3>;

[[nodiscard]] Shift difference(const Shift& a, const Shift& b) {
  Shift result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = static_cast<std::int16_t>(a[k] - b[k]);
  return result;
}

}  // namespace

class Candidates::Builder {
 public:
  Builder(const AtomsView& atoms, double skin, Candidates& result)
      : atoms_(atoms),
        grid_(atoms, (longest_bond + skin) * rounding_margin),
        skin_(skin),
        result_(result) {}

  void build() {
    number_points();
    count_links();
    fill_links();
    link_reverse_directions();
    find_crossings();
  }

 private:
  [[nodiscard]] std::vector<std::uint32_t> home_points_by_block();
  void number_points();
  void count_links();
  void fill_links();
  void link_reverse_directions();
  void find_crossings();
  [[nodiscard]] Shift shift_of(std::uint32_t point) const;

  // Calls visit(atom, point) for all pairs that may become bonds of their two elements.
  template <typename Visit>
  void for_each_link(const Visit& visit) const {
    for_each_chunk(grid_.points().size(), [&](std::size_t begin, std::size_t end) {
      grid_.for_each_neighbor(
          begin, end, [&](std::size_t p, std::size_t q, const auto&, double squared_distance) {
            const GridPoint& from = grid_.points()[p];
            const GridPoint& to = grid_.points()[q];
            const std::uint32_t a = from.atom;
            const std::uint32_t b = to.atom;
            if (squared_distance <= 0.0) throw_coincident("rebo", a, b);
            // Both parameterizations end their bonds at the same lengths.
            const double reach =
                brenner_2002.bond(atoms_.species[a], atoms_.species[b]).cutoff.end + skin_;
            if (is_nearer(atoms_, from, to, {squared_distance, reach * reach})) {
              visit(number_[p], number_[q]);
            }
          });
    });
  }

  const AtomsView& atoms_;
  CellGrid grid_;
  double skin_;
  Candidates& result_;
  std::vector<std::uint32_t> number_;  // point of the grid → point of the candidates
};

// Cuts a range of atoms in one block of space into tiles; small blocks share one.
void add_tiles(std::uint32_t begin, std::uint32_t end, std::vector<std::uint32_t>& tiles) {
  constexpr std::uint32_t max_atoms = 1024;
  if (!tiles.empty() && end - tiles.back() <= max_atoms) return;
  const std::uint32_t pieces = (end - begin + max_atoms - 1) / max_atoms;
  for (std::uint32_t piece = 0; piece < pieces; ++piece) {
    tiles.push_back(begin +
                    static_cast<std::uint32_t>(std::uint64_t{end - begin} * piece / pieces));
  }
}

// Number of a block along a curve that visits all eight blocks of a cube of them before the next
// cube [Morton1966]: what is near in space is mostly near in memory. Blocks so far away that their
// numbers are cut off only share a tile with others.
std::uint64_t place_on_curve(const Eigen::Array<std::uint64_t, 3, 1>& block) {
  const auto spread = [](std::uint64_t bits) {  // 21 bits, two zeros after each
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x001f00000000ffff;
    bits = (bits | bits << 16) & 0x001f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
  };
  return spread(block[0]) | spread(block[1]) << 1 | spread(block[2]) << 2;
}

// The points that are atoms, sorted by blocks of space; sets the tiles that follow from it.
std::vector<std::uint32_t> Candidates::Builder::home_points_by_block() {
  struct Place {
    std::uint64_t block;
    std::uint32_t point;
    bool operator<(const Place& other) const {
      return block != other.block ? block < other.block : point < other.point;
    }
  };
  const auto points = grid_.points();
  Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  for (const GridPoint& point : points) lowest = lowest.min(point.position.array());
  constexpr double width = 46.0;  // of a block [Å]: a square of graphene that wide has 800 atoms
  std::vector<Place> places;
  places.reserve(atoms_.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!points[p].is_home) continue;
    const Eigen::Array<std::uint64_t, 3, 1> block =
        ((points[p].position.array() - lowest) / width).min(0x1p52).cast<std::uint64_t>();
    places.push_back({place_on_curve(block), static_cast<std::uint32_t>(p)});
  }
  tbb::parallel_sort(places.begin(), places.end());

  std::vector<std::uint32_t> sorted;
  sorted.reserve(places.size());
  std::uint32_t begin = 0;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    sorted.push_back(places[i].point);
    if (i + 1 < places.size() && places[i + 1].block == places[i].block) continue;
    add_tiles(begin, i + 1, result_.tiles);
    begin = i + 1;
  }
  result_.tiles.push_back(begin);
  return sorted;
}

void Candidates::Builder::number_points() {
  const auto points = grid_.points();
  std::vector<std::uint32_t> atom_number(atoms_.size());
  result_.order.reserve(atoms_.size());
  result_.species.reserve(atoms_.size());
  bool is_wrapped = false;
  for (const std::uint32_t p : home_points_by_block()) {
    const GridPoint& point = points[p];
    atom_number[point.atom] = static_cast<std::uint32_t>(result_.order.size());
    result_.order.push_back(point.atom);
    result_.species.push_back(atoms_.species[point.atom]);
    is_wrapped = is_wrapped || point.image != Shift{};
  }
  number_.resize(points.size());
  if (is_wrapped) result_.wraps.resize(atoms_.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::uint32_t home = atom_number[points[p].atom];
    if (!points[p].is_home) continue;
    number_[p] = home;
    if (is_wrapped) result_.wraps[home] = points[p].image;
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p].is_home) continue;
    const std::uint32_t home = atom_number[points[p].atom];
    number_[p] = static_cast<std::uint32_t>(result_.point_count());
    const Shift home_shift = is_wrapped ? result_.wraps[home] : Shift{};
    result_.images.push_back({home, difference(points[p].image, home_shift)});
  }
}

/// Of one atom. The time grows with the third power of it, and diamond has four.
constexpr std::uint32_t max_neighbors = 200;

void Candidates::Builder::count_links() {
  result_.first.assign(atoms_.size() + 1, 0);
  for_each_link([&](std::uint32_t atom, std::uint32_t) {
    if (++result_.first[atom + 1] > max_neighbors) {
      throw InvalidAtoms(concat("rebo: more than ", max_neighbors,
                                " atoms are within reach of atom ", result_.order[atom],
                                "; they are too dense for any potential"));
    }
  });
  std::uint64_t sum = 0;
  for (std::uint32_t& count : result_.first) {
    sum += count;
    if (sum >= std::numeric_limits<std::uint32_t>::max()) {
      throw InvalidAtoms(
          "rebo: more than 2^32 - 2 pairs within the cutoff; the atoms are too dense");
    }
    count = static_cast<std::uint32_t>(sum);
  }
}

void Candidates::Builder::fill_links() {
  result_.point.resize(result_.first.back());
  result_.reverse.resize(result_.first.back());
  // Links of an atom come one after the other; the next free place is kept in its first reverse.
  std::vector<std::uint32_t>& filled = result_.reverse;
  std::ranges::fill(filled, 0);
  for_each_link([&](std::uint32_t atom, std::uint32_t point) {
    const std::uint32_t first = result_.first[atom];
    result_.point[first + filled[first]++] = point;
  });
}

std::array<std::int16_t, 3> Candidates::Builder::shift_of(std::uint32_t point) const {
  return point < result_.count() ? Shift{} : result_.images[point - result_.count()].shift;
}

void Candidates::Builder::link_reverse_directions() {
  for_each_chunk(atoms_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::uint32_t link = result_.first[i]; link < result_.first[i + 1]; ++link) {
        const std::uint32_t there = result_.home(result_.point[link]);
        const Shift back = difference(Shift{}, shift_of(result_.point[link]));
        std::uint32_t other = result_.first[there];
        while (result_.home(result_.point[other]) != i || shift_of(result_.point[other]) != back) {
          ++other;
        }
        result_.reverse[link] = other;
      }
    }
  });
}

void Candidates::Builder::find_crossings() {
  std::vector<Crossing>& crossings = result_.crossings;
  for (std::size_t tile = 0; tile < result_.tile_count(); ++tile) {
    result_.first_crossing.push_back(static_cast<std::uint32_t>(crossings.size()));
    const std::uint32_t begin = result_.first[result_.tiles[tile]];
    const std::uint32_t end = result_.first[result_.tiles[tile + 1]];
    for (std::uint32_t i = result_.tiles[tile]; i < result_.tiles[tile + 1]; ++i) {
      for (std::uint32_t link = result_.first[i]; link < result_.first[i + 1]; ++link) {
        const bool is_inside = begin <= result_.reverse[link] && result_.reverse[link] < end;
        if (!is_inside) crossings.push_back({i, link, 0});
      }
    }
  }
  result_.first_crossing.push_back(static_cast<std::uint32_t>(crossings.size()));
  for (Crossing& crossing : crossings) {
    const auto other =
        std::ranges::lower_bound(crossings, result_.reverse[crossing.link], {}, &Crossing::link);
    crossing.back = static_cast<std::uint32_t>(other - crossings.begin());
  }
}

Candidates::Candidates(const AtomsView& atoms, double skin) { Builder(atoms, skin, *this).build(); }

}  // namespace trivalent::potentials::rebo_detail
