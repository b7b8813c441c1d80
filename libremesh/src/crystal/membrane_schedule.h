#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "trivalent/remesh/crystallize.h"

/// The edge lengths, temperatures and rounds of membrane_search.cpp.
namespace trivalent::remesh {

/// One annealing, at one edge length.
struct Level {
  int coarseness;  ///< edge length / target length
  /// [eV] of cores. At the target length they and the width of rings are fitted to REBO's energies
  /// of icosahedral fullerenes, tori and schwarzites. At coarse lengths rings have no width; on
  /// each division a disclination gains about (π/3) κ ln 2 ≈ 1 of bending energy.
  double pentagon;
  double heptagon;
  double octagon;
  double ring_width;    ///< of Membrane
  double min_vertices;  ///< of a first net: it needs room for patches
  /// How a net freezes is luck, so that a small one is ordered up to so many times, and the order
  /// of least energy is taken.
  int max_orders;
  double vertex_rounds;  ///< vertices · rounds of all orders together, within the limits
  /// The same of nets with open edges or creases, whose defects have farther to go: with fewer, X
  /// junctions of (10,10) tubes keep a pair.
  double vertex_rounds_with_curves;
  double max_rounds;  ///< of one order: on small nets several short ones find more
  double hot;         ///< [eV] temperature at which an order begins
  double molten;      ///< [eV] the same of every other one: crystals turn only once they melt
};
inline constexpr std::array<Level, 5> levels = {
    {{16, 4.6, 1.5, 9.0, 0.0, 90, 8, 3.0e6, 3.0e6, 5000, 4.0, 4.0},
     {8, 3.7, 0.6, 7.2, 0.0, 200, 8, 3.0e6, 3.0e6, 5000, 4.0, 4.0},
     {4, 2.8, -0.3, 5.4, 0.0, 350, 4, 2.0e6, 3.0e6, 5000, 4.0, 4.0},
     {2, 1.9, -1.2, 3.6, 0.0, 150, 4, 3.4e6, 6.0e6, 5000, 4.0, 4.0},
     {1, 1.6, -1.4, -2.8, 0.7, 0, 4, 5.8e6, 5.8e6, 4800, 2.0, 4.0}}};

/// Temperatures [eV] and rounds of an annealing.
struct Schedule {
  double hot;
  double cold;
  int rounds;
};
/// The first net orders as a whole: slowly.
inline constexpr double ordering_cold = 0.1;
inline constexpr double min_ordering_rounds = 1200.0;
/// The same of a quick search, which makes a part of these: with 1,400 the elephant of 20,000 atoms
/// comes out at 58 meV/atom, with 2,400 at 51.
inline constexpr double min_quick_rounds = 2000.0;
/// The order of a coarse net still has pairs to lose at half its length.
inline constexpr Schedule refining = {.hot = 1.0, .cold = 0.1, .rounds = 400};
/// At finer lengths defects only find their places.
inline constexpr Schedule settling = {.hot = 0.2, .cold = 0.0, .rounds = 20};
/// Where the number of vertices must change, dislocations have to climb through the net.
inline constexpr Schedule climbing = {.hot = 0.5, .cold = 0.0, .rounds = 60};
/// Nets of edges so many times as long as wanted, or more, have few places for disclinations, which
/// are moved once more when the net is divided. At twice the length, the elephant of 20,000 atoms
/// comes out at 43.3 meV/atom with that and 42.0 without.
inline constexpr int coarse_places = 4;
/// At so many times the length, or more, dislocations have large Burgers vectors: each costs so
/// much more at last than the coarse net says. Four pairs of a sphere of 40,000 atoms, ordered at
/// eight times the length, cost 51 eV, one of a sphere of 50,000 atoms 20 eV.
inline constexpr int coarse_pairs = 8;
inline constexpr double price_of_pair = 15.0;  // [eV]
/// [eV] of Membrane::pair while a net settles: cores of lone disclinations alone make pairs too
/// cheap. Relaxed under REBO, Y and X junctions of 2,100 to 2,600 atoms pay 1.0 to 1.9 eV more for
/// a pair than the membrane does. A net that orders moves its defects by pairs: P, gyroid and
/// spheres of 960 atoms come out worse with this term.
inline constexpr double settled_pair = 1.3;
/// [eV] of Membrane::count in coarse nets of periodic cells: once divided, a net without pairs
/// cannot change its number any more. With 8, orders are worse: gyroid of 1,536 atoms 80.3 instead
/// of 71.8 meV/atom.
inline constexpr double exact_count = 3.0;
/// A free surface may have so many more or fewer vertices than wanted [of those].
inline constexpr double free_count = 0.01;
/// The same of a net carried over to the surface beside it, which has room for about so many.
inline constexpr double free_count_beside = 0.03;
/// Of annealing a cell's net of few vertices. The first finds the octagons of P, D and the gyroid
/// at once; of the others, one of ten to four finds those of P, one of 27 those of the gyroid with
/// 288 atoms.
inline int runs_of_cell_nets(Effort effort) {
  return effort == Effort::quick ? 4 : effort == Effort::normal ? 12 : 48;
}
/// [eV] that such a net may be above the other: the membrane makes too much of octagons. P of 192
/// atoms has 22.2 eV under REBO with twelve of them, 26.2 eV as a membrane; the best nets without
/// have 25.5 to 27.5 eV under REBO, one of which was below the octagon net as a membrane.
inline constexpr double favor_of_cell_nets = 3.0;
inline constexpr int tidying_rounds = 20;  // that mend valences outside 5 to 7

/// Rounds of a schedule: fewer for a quick search, more for a thorough one.
inline int rounds_for(const Schedule& schedule, Effort effort) {
  // Defects need some rounds to find their places, however short the search.
  constexpr int min_rounds = 60;
  return std::max(static_cast<int>(std::lround(schedule.rounds * effort_factor(effort))),
                  std::min(schedule.rounds, min_rounds));
}

/// How often and how long a first net is ordered.
struct OrderPlan {
  int orders;
  Schedule schedule;
};

inline OrderPlan plan_order(const Level& level, double vertices, Effort effort) {
  // A quick search does not choose among coarse orders: it makes one in less time.
  const bool is_single = effort == Effort::quick && level.coarseness >= coarse_places;
  const double vertex_rounds = (is_single ? 0.75 : 1.0) * level.vertex_rounds;
  const double affordable = vertex_rounds / (vertices * min_ordering_rounds);
  const int orders = effort == Effort::quick
                         ? 1
                         : static_cast<int>(std::clamp(affordable, 1.0, 1.0 * level.max_orders));
  const double min_rounds = effort == Effort::quick ? min_quick_rounds : min_ordering_rounds;
  const double rounds =
      std::clamp(vertex_rounds / (vertices * orders), min_rounds, level.max_rounds);
  return {orders, {.hot = level.hot, .cold = ordering_cold, .rounds = static_cast<int>(rounds)}};
}

/// Small nets are judged by the energy of their carbon, which takes less time than the search: the
/// membrane's says too little about which of several is best. Chosen by that, D of 768 atoms had
/// 141 to 154 meV/atom and the gyroid of 384 atoms 135 to 149; now 145 to 146 and 134.8 to 135.8.
inline constexpr double max_judged_vertices = 1000.0;
inline constexpr int max_judged_orders = 12;

/// [eV] and [eV/Å²] of Membrane::count and boundary_tether where a net ends in given tubes: where
/// the ends lie, and how many vertices there are, follows from where the heptagons lie. With 0.1
/// and 0.6 Y junctions of (10,10) tubes keep four to five pairs.
inline constexpr double count_of_tubes = 0.003;
inline constexpr double tether_of_tubes = 0.05;
/// Pairs cannot leave a net at ends that are fixed. Few long orders find more than many short ones:
/// with 12 orders at twice the vertex_rounds, Y junctions of (9,9) and (12,5) tubes keep three
/// pairs, with 4 one.
inline constexpr int orders_of_tubes = 6;
inline constexpr double effort_of_tubes = 2.0;  ///< times vertex_rounds and max_rounds

/// Whether a net still orders after a division into a level.
inline bool is_refined(std::size_t first_level, std::size_t level) {
  return level == first_level + 1 && levels[level].coarseness > 1;
}

}  // namespace trivalent::remesh
