#include "crystal/cell_division.h"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace trivalent::remesh {

namespace {

/// A division and how many triangles more or fewer than wanted it gives.
struct NumberedDivision {
  CellDivision division;
  int deviation;
};

/// None if the base net would have too few vertices for the curvature, or too many to be ordered.
std::optional<NumberedDivision> division_to(int wanted_faces, int euler, CellDivision division) {
  const int min_base_vertices = -5 * euler;
  constexpr int max_base_vertices = 32;
  const int each = division.triangles_each();
  const int base_faces = 2 * static_cast<int>(std::lround(0.5 * wanted_faces / each));
  division.base_vertices = euler + base_faces / 2;
  if (each == 1 || division.base_vertices < min_base_vertices ||
      division.base_vertices > max_base_vertices) {
    return std::nullopt;
  }
  return NumberedDivision{division, std::abs(base_faces * each - wanted_faces)};
}

}  // namespace

std::optional<CellDivision> plan_cell_division(int wanted_vertices, int euler) {
  constexpr double max_deviation = 0.003;  // others would win by chance only
  constexpr int max_parts = 9;
  const int wanted_faces = 2 * (wanted_vertices - euler);
  std::optional<NumberedDivision> best;
  const auto rank = [](const NumberedDivision& d) {
    return std::pair(d.deviation, d.division.base_vertices);
  };
  for (int parts = 1; parts <= max_parts; ++parts) {
    for (const bool by_sqrt3 : {true, false}) {
      const auto next = division_to(wanted_faces, euler, {0, parts, by_sqrt3});
      if (!next || next->deviation > max_deviation * wanted_faces) continue;
      if (!best || rank(*next) < rank(*best)) best = next;
    }
  }
  if (!best) return std::nullopt;
  return best->division;
}

std::optional<CellDivision> plan_cell_division(const TriMesh& surface, int wanted_vertices) {
  const int euler = euler_characteristic(surface);
  const bool is_crystal = surface.lattice.periodic() == Lattice::Periodic{true, true, true};
  if (!is_crystal || euler >= 0) return std::nullopt;
  return plan_cell_division(wanted_vertices, euler);
}

}  // namespace trivalent::remesh
