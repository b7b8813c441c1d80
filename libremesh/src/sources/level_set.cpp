#include "trivalent/remesh/level_set.h"

#include <algorithm>
#include <cmath>

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

/// Root mean square of the gradient at points spread over the cell.
double typical_slope(const ScalarField& field, const Lattice& lattice, double step) {
  constexpr int across = 9;
  double sum = 0.0;
  for (int i = 0; i < across * across * across; ++i) {
    const Eigen::Vector3d fractions(i % across, i / across % across, i / (across * across));
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double shift = lattice.periodic()[static_cast<std::size_t>(k)] ? 0.0 : 0.5;
      p += ((fractions[k] + 0.5) / across - shift) * lattice.cell().col(k);
    }
    static_cast<void>(finite_value(field, p));
    sum += gradient(field, p, step).squaredNorm();
  }
  return std::sqrt(sum / (across * across * across));
}

}  // namespace

TriMesh level_set(const ScalarField& field, double level, const Lattice& lattice,
                  double edge_length) {
  const double step = 1e-3 * edge_length;
  // Where the function is flat, a step along the gradient would lead anywhere.
  constexpr double flat = 0.2;
  const double min_slope = flat * typical_slope(field, lattice, step);
  if (!(min_slope > 0.0)) {
    throw InvalidMesh("level_set: the function is the same everywhere; there is no surface");
  }
  // About the distance to the surface, near it.
  const auto value = [&](const Eigen::Vector3d& p) {
    const double slope = gradient(field, p, step).norm();
    return (finite_value(field, p) - level) / std::max(slope, min_slope);
  };
  return polygonize({.value = value, .lattice = lattice}, edge_length);
}

}  // namespace trivalent::remesh
