#include "trivalent/remesh/level_set.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sources/implicit_surface.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

Eigen::Vector3d gradient(const ScalarField& field, const Eigen::Vector3d& p, double step) {
  Eigen::Vector3d g;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
    g[k] = (field(p + d) - field(p - d)) / (2.0 * step);
  }
  return g;
}

double finite_value(const ScalarField& field, const Eigen::Vector3d& p) {
  const double value = field(p);
  if (std::isfinite(value)) return value;
  throw InvalidMesh(concat("level_set: the function is ", value, " at (", p.x(), ", ", p.y(), ", ",
                           p.z(), "); it must be finite in the whole cell"));
}

/// Points spread over the cell.
std::vector<Eigen::Vector3d> sample_points(const Lattice& lattice) {
  constexpr int across = 9;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < across * across * across; ++i) {
    const Eigen::Vector3i place(i % across, i / across % across, i / (across * across));
    const Eigen::Vector3d fractions = place.cast<double>();
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double shift = lattice.periodic()[static_cast<std::size_t>(k)] ? 0.0 : 0.5;
      p += ((fractions[k] + 0.5) / across - shift) * lattice.cell().col(k);
    }
    points.push_back(p);
  }
  return points;
}

/// @throws InvalidMesh unless the function is the same one cell vector further.
void check_repeats(const ScalarField& field, const Lattice& lattice,
                   const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Eigen::Vector3d& p : points) values.push_back(finite_value(field, p));
  const auto [low, high] = std::ranges::minmax_element(values);
  // A cell typed with three digits passes.
  const double tolerance = 0.01 * (*high - *low);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!lattice.periodic()[k]) continue;
      const Eigen::Vector3d& p = points[i];
      const double further =
          finite_value(field, p + lattice.cell().col(static_cast<Eigen::Index>(k)));
      if (std::abs(further - values[i]) <= tolerance) continue;
      throw InvalidMesh(concat("level_set: the function does not repeat along cell vector ", k + 1,
                               ": at (", p.x(), ", ", p.y(), ", ", p.z(), ") it is ", values[i],
                               ", one vector further ", further,
                               "; give the cell in which it repeats"));
    }
  }
}

/// Root mean square of the gradient.
double typical_slope(const ScalarField& field, const std::vector<Eigen::Vector3d>& points,
                     double step) {
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points) sum += gradient(field, p, step).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

/// @throws InvalidMesh where the function jumps from one side of the level to the other, as at a
/// pole:
///   it is nearer to the level a little way off than on the surface then.
void check_continuous(const ScalarField& field, double level, const TriMesh& surface,
                      double edge_length) {
  constexpr double reach = 0.25;     // edges
  constexpr double farther = 2.0;    // times
  constexpr double max_part = 0.01;  // of the vertices: relaxed ones are a little off the surface
  std::size_t n_jumps = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (const auto v : surface.vertices()) {
    const Eigen::Vector3d& p = surface.point(v);
    const Eigen::Vector3d slope = gradient(field, p, 1e-3 * edge_length);
    const Eigen::Vector3d away = reach * edge_length * slope.normalized();
    const double beside =
        std::max(std::abs(field(p + away) - level), std::abs(field(p - away) - level));
    if (std::abs(field(p) - level) <= farther * beside) continue;
    ++n_jumps;
    place = p;
  }
  if (static_cast<double>(n_jumps) <= max_part * static_cast<double>(surface.n_vertices())) return;
  throw InvalidMesh(concat("level_set: the function jumps across the level ", level, " near (",
                           place.x(), ", ", place.y(), ", ", place.z(),
                           "), as at a pole, where it has no surface; write the function without "
                           "the pole"));
}

}  // namespace

TriMesh level_set(const ScalarField& field, double level, const Lattice& lattice,
                  double edge_length) {
  const double step = 1e-3 * edge_length;
  // Where the function is flat, a step along the gradient would lead anywhere.
  constexpr double flat = 0.2;
  const std::vector<Eigen::Vector3d> points = sample_points(lattice);
  check_repeats(field, lattice, points);
  const double min_slope = flat * typical_slope(field, points, step);
  if (!(min_slope > 0.0)) {
    throw InvalidMesh("level_set: the function is the same everywhere; there is no surface");
  }
  // About the distance to the surface, near it.
  const auto value = [&](const Eigen::Vector3d& p) {
    const double slope = gradient(field, p, step).norm();
    return (finite_value(field, p) - level) / std::max(slope, min_slope);
  };
  TriMesh surface = polygonize_any({.value = value, .lattice = lattice}, edge_length);
  check_continuous(field, level, surface, edge_length);
  return surface;
}

}  // namespace trivalent::remesh
