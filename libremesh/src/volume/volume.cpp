#include "trivalent/remesh/volume.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/level_set.h"

namespace trivalent::remesh {

namespace {

/// Weights of the four points around a place, where t of a step is behind the second [Keys1981].
std::array<double, 4> cubic_weights(double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
          0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)};
}

/// The points that a value between them is made of, along one axis.
struct Stencil {
  std::array<std::size_t, 4> points;
  std::array<double, 4> weights;
};

Stencil stencil_at(double place, int size, bool is_periodic) {
  if (!is_periodic) place = std::clamp(place, 0.0, static_cast<double>(size - 1));
  const double before = std::floor(place);
  Stencil stencil = {.points = {}, .weights = cubic_weights(place - before)};
  const auto first = static_cast<long>(before) - 1;
  for (long k = 0; k < 4; ++k) {
    const long index =
        is_periodic ? ((first + k) % size + size) % size : std::clamp<long>(first + k, 0, size - 1);
    stencil.points[static_cast<std::size_t>(k)] = static_cast<std::size_t>(index);
  }
  return stencil;
}

/// How many steps of each axis make a cell: one less than points where the last repeat the first.
std::array<int, 3> periods_of(const Volume& volume, const Lattice::Periodic& periodic) {
  constexpr double rounding = 1e-5;  // of the values' range: five digits of text
  const auto [low, high] = std::ranges::minmax_element(volume.values);
  const double tolerance = rounding * (static_cast<double>(*high) - static_cast<double>(*low));
  std::array<int, 3> periods = volume.size;
  std::size_t stride = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto n = static_cast<std::size_t>(volume.size[k]);
    const std::size_t to_last = (n - 1) * stride;
    double largest = 0.0;
    for (std::size_t i = 0; periodic[k] && i < volume.values.size(); ++i) {
      if (i / stride % n != 0) continue;
      const double difference =
          static_cast<double>(volume.values[i + to_last]) - static_cast<double>(volume.values[i]);
      largest = std::max(largest, std::abs(difference));
    }
    if (periodic[k] && largest <= tolerance) --periods[k];
    stride *= n;
  }
  return periods;
}

/// The volume without last points that repeat the first ones: they would be counted twice.
Volume without_repeats(const Volume& volume, const std::array<int, 3>& periods) {
  Volume cell = {.size = periods, .origin = volume.origin, .steps = volume.steps, .values = {}};
  for (int z = 0; z < periods[2]; ++z) {
    for (int y = 0; y < periods[1]; ++y) {
      const auto row =
          volume.values.begin() + static_cast<std::ptrdiff_t>(volume.size[0]) *
                                      (y + static_cast<std::ptrdiff_t>(volume.size[1]) * z);
      cell.values.insert(cell.values.end(), row, row + periods[0]);
    }
  }
  return cell;
}

/// Which side of the level the points of a border are on.
struct Sides {
  bool lower = false;
  bool higher = false;
};

Sides sides_at(const Volume& volume, double level, std::size_t axis, bool is_last) {
  Sides sides;
  std::size_t stride = 1;
  for (std::size_t k = 0; k < axis; ++k) stride *= static_cast<std::size_t>(volume.size[k]);
  const auto n = static_cast<std::size_t>(volume.size[axis]);
  for (std::size_t i = 0; i < volume.values.size(); ++i) {
    if (i / stride % n != (is_last ? n - 1 : 0)) continue;
    (static_cast<double>(volume.values[i]) < level ? sides.lower : sides.higher) = true;
  }
  return sides;
}

/// Which side of the level all borders are on that are not periodic.
///
/// @throws InvalidMesh if the surface reaches one of them.
Sides border_sides(const Volume& volume, double level, const Lattice::Periodic& periodic) {
  Sides all;
  for (std::size_t border = 0; border < 6; ++border) {
    const std::size_t axis = border / 2;
    const bool is_last = border % 2 == 1;
    if (periodic[axis]) continue;
    const Sides sides = sides_at(volume, level, axis, is_last);
    if (sides.lower && sides.higher) {
      throw InvalidMesh(concat(
          "level_set: the surface at ", level, " reaches the ", is_last ? "last" : "first",
          " points of axis ", "xyz"[axis],
          "; choose another level, leave a margin around what is inside, or say that the axis "
          "is periodic"));
    }
    all.lower = all.lower || sides.lower;
    all.higher = all.higher || sides.higher;
  }
  return all;
}

/// Whether the surface is to be turned inside out.
///
/// @throws InvalidMesh if it does not close within the volume.
bool is_higher_inside(const Volume& volume, double level, const Lattice::Periodic& periodic) {
  const Sides sides = border_sides(volume, level, periodic);
  if (periodic != Lattice::Periodic{}) return false;
  if (sides.lower && sides.higher) {
    throw InvalidMesh(concat("level_set: some borders of the volume lie above the level ", level,
                             ", some below; the surface does not close within the volume"));
  }
  return sides.lower;
}

}  // namespace

double Volume::value_at(const Eigen::Vector3d& p, const Lattice::Periodic& periodic) const {
  const Eigen::Vector3d place = steps.inverse() * (p - origin);
  std::array<Stencil, 3> along;
  for (std::size_t k = 0; k < 3; ++k) {
    along[k] = stencil_at(place[static_cast<Eigen::Index>(k)], size[k], periodic[k]);
  }
  const auto nx = static_cast<std::size_t>(size[0]);
  const auto ny = static_cast<std::size_t>(size[1]);
  double sum = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t b = 0; b < 4; ++b) {
      const std::size_t row = nx * (along[1].points[b] + ny * along[2].points[c]);
      double in_row = 0.0;
      for (std::size_t a = 0; a < 4; ++a) {
        in_row += along[0].weights[a] * static_cast<double>(values[row + along[0].points[a]]);
      }
      sum += along[2].weights[c] * along[1].weights[b] * in_row;
    }
  }
  return sum;
}

Lattice lattice_of(const Volume& volume, const Lattice::Periodic& periodic) {
  const std::array<int, 3> periods = periods_of(volume, periodic);
  Lattice::Cell cell = volume.steps;
  for (std::size_t k = 0; k < 3; ++k) {
    cell.col(static_cast<Eigen::Index>(k)) *= periodic[k] ? periods[k] : volume.size[k] - 1;
  }
  return {cell, periodic};
}

TriMesh level_set(const Volume& volume, double level, const Lattice::Periodic& periodic,
                  double edge_length) {
  const auto [low, high] = std::ranges::minmax_element(volume.values);
  if (!(level > static_cast<double>(*low) && level < static_cast<double>(*high))) {
    throw InvalidMesh(concat("level_set: no surface at ", level, ": the volume's values go from ",
                             *low, " to ", *high, "; choose a level between them"));
  }
  const double sign = is_higher_inside(volume, level, periodic) ? -1.0 : 1.0;
  const Lattice lattice = lattice_of(volume, periodic);
  const std::array<int, 3> periods = periods_of(volume, periodic);
  const bool has_repeats = periods != volume.size;
  const Volume first_points = has_repeats ? without_repeats(volume, periods) : Volume{};
  const Volume& cell = has_repeats ? first_points : volume;
  // A frame lies around the origin, a cell begins there.
  Eigen::Vector3d start = volume.origin;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (!periodic[static_cast<std::size_t>(k)]) start += 0.5 * lattice.cell().col(k);
  }
  const auto field = [&](const Eigen::Vector3d& p) {
    return sign * cell.value_at(p + start, periodic);
  };
  TriMesh mesh = level_set(field, sign * level, lattice, edge_length);
  for (const auto v : mesh.vertices()) mesh.point(v) += start;
  return mesh;
}

}  // namespace trivalent::remesh
