#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "ideal_edges.h"
#include "lattice_vector.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/ideal_structures.h"

namespace trivalent::dual {
namespace {

using Count = std::int64_t;

/// The quotient rounded down, and what is left.
std::pair<Count, Count> divided(Count number, Count by) {
  const Count quotient = number >= 0 ? number / by : -((by - 1 - number) / by);
  return {quotient, number - quotient * by};
}

/// The strip of graphene that becomes a tube: parallelogram of the chiral vector C and the
/// translation T [Saito1998, Sections 3.2 and 3.3].
class Strip {
 public:
  explicit Strip(const Nanotube& tube) : chiral_{tube.n, tube.m} {
    const Count divisor = std::gcd(2 * chiral_.j + chiral_.i, 2 * chiral_.i + chiral_.j);
    translation_ = {tube.cells * (2 * chiral_.j + chiral_.i) / divisor,
                    -tube.cells * (2 * chiral_.i + chiral_.j) / divisor};
    n_points_ = chiral_.j * translation_.i - chiral_.i * translation_.j;
  }

  /// Points of the lattice inside: half as many as atoms.
  [[nodiscard]] Count n_points() const { return n_points_; }

  /// How far around and along a point lies, in parts of n_points().
  struct Place {
    Count around;
    Count along;
  };
  [[nodiscard]] Place place(const LatticeVector& p) const {
    return {translation_.i * p.j - translation_.j * p.i, chiral_.j * p.i - chiral_.i * p.j};
  }

  /// All points inside, each once.
  [[nodiscard]] std::vector<LatticeVector> points() const {
    std::vector<LatticeVector> inside;
    for (Count j = translation_.j; j <= chiral_.j; ++j) {
      // From where the point is 0 around on: -t2 i >= -t1 j.
      const Count first = -divided(translation_.i * j, -translation_.j).first;
      for (Count i = first;; ++i) {
        const Place at = place({i, j});
        if (at.around >= n_points_) break;
        if (at.along >= 0 && at.along < n_points_) inside.push_back({i, j});
      }
    }
    return inside;
  }

 private:
  LatticeVector chiral_;
  LatticeVector translation_ = {};
  Count n_points_ = 0;
};

double length_of(double i, double j) {
  return std::numbers::sqrt3 * graphene_bond * std::sqrt(i * i + i * j + j * j);
}

void check(const Nanotube& tube) {
  if (tube.n < 1 || tube.m < 0 || tube.cells < 1) {
    throw InvalidOption(concat("nanotube: n = ", tube.n, ", m = ", tube.m, ", cells = ", tube.cells,
                               "; n and cells must be at least 1, m at least 0"));
  }
  const double around = length_of(tube.n, tube.m);
  if (around < 0.999 * length_of(3, 0)) {
    throw InvalidOption(concat("nanotube: (", tube.n, ",", tube.m,
                               ") is too thin; (3,0) and (2,2) are the thinnest"));
  }
  constexpr double max_index = 10000;
  if (tube.n > max_index || tube.m > max_index || tube.cells > 10 * max_index) {
    throw InvalidOption("nanotube: n and m can be at most 10000, cells at most 100000");
  }
}

}  // namespace

Structure nanotube(const Nanotube& tube) {
  check(tube);
  const Strip strip(tube);
  require_few_atoms("nanotube", 2.0 * static_cast<double>(strip.n_points()));
  const double radius = length_of(tube.n, tube.m) / (2.0 * std::numbers::pi);
  const double area_per_point = 1.5 * std::numbers::sqrt3 * graphene_bond * graphene_bond;
  const auto n_points = static_cast<double>(strip.n_points());
  const double length = n_points * area_per_point / length_of(tube.n, tube.m);

  Structure structure;
  // Atom 2p sits on the point p of the strip, atom 2p + 1 a third of a1 + a2 from it.
  const std::vector<LatticeVector> points = strip.points();
  std::unordered_map<Count, std::uint32_t> index_of;
  for (const LatticeVector& p : points) {
    const Strip::Place at = strip.place(p);
    index_of[at.around * strip.n_points() + at.along] = static_cast<std::uint32_t>(index_of.size());
    const Strip::Place third = strip.place({1, 1});
    for (const double part : {0.0, 1.0 / 3.0}) {
      const double angle =
          2.0 * std::numbers::pi / n_points *
          (static_cast<double>(at.around) + part * static_cast<double>(third.around));
      const double z = length / n_points *
                       (static_cast<double>(at.along) + part * static_cast<double>(third.along));
      structure.atoms.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                             z - 0.5 * length);
    }
  }
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const auto [i, j] = points[p];
    for (const LatticeVector& next : {LatticeVector{i, j}, {i + 1, j}, {i, j + 1}}) {
      // The other sublattice's atom of the point before is bonded to this one.
      const Strip::Place at = strip.place(next);
      const auto [turns, around] = divided(at.around, strip.n_points());
      const auto [image, along] = divided(at.along, strip.n_points());
      structure.bonds.push_back({.first = 2 * index_of.at(around * strip.n_points() + along),
                                 .second = 2 * p + 1,
                                 .image = {0, 0, static_cast<std::int32_t>(-image)}});
    }
  }
  structure.atoms.species.assign(structure.atoms.positions.size(), potentials::Species::carbon);
  const double side = 2.0 * radius + vacuum;
  structure.atoms.box.cell.diagonal() = Eigen::Vector3d(side, side, length);
  structure.atoms.box.origin = -0.5 * structure.atoms.box.cell.diagonal();
  structure.atoms.box.periodic = {false, false, true};
  close_edges(structure, tube.edges);
  return structure;
}

Structure graphene_sheet(int n_x, int n_y, Edges edges) {
  if (n_x < 1 || n_y < 1) {
    throw InvalidOption(
        concat("graphene: ", n_x, " by ", n_y, " cells; at least 1 by 1 must be there"));
  }
  require_few_atoms("graphene", 4.0 * n_x * n_y);
  const potentials::Atoms cell = graphene_cell();
  Structure structure;
  potentials::Atoms& atoms = structure.atoms;
  for (int x = 0; x < n_x; ++x) {
    for (int y = 0; y < n_y; ++y) {
      for (const Eigen::Vector3d& position : cell.positions) {
        atoms.positions.push_back(cell.box.shifted(position, std::array{x, y, 0}));
      }
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  atoms.box = cell.box;
  atoms.box.cell.col(0) *= n_x;
  atoms.box.cell.col(1) *= n_y;
  atoms.box.origin.z() = -0.5 * atoms.box.cell(2, 2);
  const auto add = [&](int x, int y, int k, std::array<int, 2> step, int other) {
    const auto index = [&](Count column, Count row, int atom) {
      return static_cast<std::uint32_t>(4 * (column * n_y + row) + atom);
    };
    const auto [image_x, column] = divided(x + step[0], n_x);
    const auto [image_y, row] = divided(y + step[1], n_y);
    structure.bonds.push_back(
        {.first = index(x, y, k),
         .second = index(column, row, other),
         .image = {static_cast<std::int32_t>(image_x), static_cast<std::int32_t>(image_y), 0}});
  };
  for (int x = 0; x < n_x; ++x) {
    for (int y = 0; y < n_y; ++y) {
      add(x, y, 0, {0, 0}, 1);
      add(x, y, 1, {0, 0}, 2);
      add(x, y, 2, {0, 0}, 3);
      add(x, y, 2, {1, 0}, 1);
      add(x, y, 3, {0, 1}, 0);
      add(x, y, 3, {1, 1}, 0);
    }
  }
  close_edges(structure, edges);
  return structure;
}

}  // namespace trivalent::dual
