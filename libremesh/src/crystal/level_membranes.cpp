#include "crystal/level_membranes.h"

#include <algorithm>
#include <cmath>

#include "crystal/tether_strength.h"
#include "mesh/adjacency.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

LevelMembranes::LevelMembranes(const TriMesh& surface, const CrystalOptions& options)
    : options_(options),
      area_(surface_area(surface)),
      euler_characteristic_(euler_characteristic(surface)),
      is_open_(has_boundary(surface)),
      is_periodic_(surface.lattice.is_periodic()),
      ends_in_tubes_(edge_length_of_tubes(surface)),
      tether_factor_(is_held(options) ? 1.0 : tether_factor(surface, area_)) {}

double LevelMembranes::n_vertices() const {
  return area_ / (2.0 * unit_triangle_area * Membrane::fine_length * Membrane::fine_length);
}

int LevelMembranes::wanted_faces(const Level& level) const {
  const double face_area = unit_triangle_area * Membrane::fine_length * Membrane::fine_length;
  const double faces =
      options_.wanted_faces.value_or(area_ / face_area) / (level.coarseness * level.coarseness);
  if (is_open_) return static_cast<int>(std::lround(faces));
  return 2 * static_cast<int>(std::lround(0.5 * faces));
}

int LevelMembranes::wanted_vertices() const {
  return euler_characteristic_ + wanted_faces(levels.back()) / 2;
}

Membrane LevelMembranes::at(const Level& level) const {
  const TetherStrength strength = tether_of(options_);
  Membrane membrane;
  membrane.length = level.coarseness * Membrane::fine_length;
  const bool is_stiffer = tether_factor_ > 1.0;
  membrane.tether = tether_factor_ * strength.tether;
  membrane.cover = (is_stiffer ? std::sqrt(tether_factor_) : tether_factor_) * strength.cover;
  membrane.slack = strength.slack / (is_stiffer ? std::sqrt(tether_factor_) : 1.0);
  membrane.pentagon = level.pentagon;
  membrane.heptagon = level.heptagon;
  membrane.octagon = level.octagon;
  membrane.ring_width = level.ring_width;
  // 0.02 lets small nets lose a fifth of their vertices; 0.3 + 60/V leaves nets of 120 one short.
  membrane.count = 0.3 + 240.0 / n_vertices();
  if (is_periodic_ && level.coarseness > 1) membrane.count = exact_count;
  if (ends_in_tubes_) {
    membrane.count = count_of_tubes;
    membrane.boundary_tether = tether_of_tubes;
    if (level.coarseness == 1) membrane.pair = settled_pair;
  }
  return membrane;
}

Membrane LevelMembranes::last() const {
  Membrane membrane = at(levels.back());
  if (!is_held(options_) && !is_open_) membrane.tether = membrane.cover = 0.0;
  return membrane;
}

double price_of_pairs(const TriMesh& net, const Level& level) {
  if (level.coarseness < coarse_pairs) return 0.0;
  const auto heptagons =
      std::ranges::count_if(net.vertices(), [](const auto v) { return v.valence() > 6; });
  return price_of_pair * static_cast<double>(heptagons);
}

}  // namespace trivalent::remesh
