#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "random_atoms.h"
#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::testing_support {

/// Periodic graphene of nx × ny rectangular cells of four atoms, flat at z = 0 [Å].
[[nodiscard]] inline potentials::Atoms graphene(int nx, int ny, double bond) {
  const double width = std::sqrt(3.0) * bond;
  const double height = 3.0 * bond;
  potentials::Atoms atoms;
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      const Eigen::Vector3d corner(x * width, y * height, 0.0);
      for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.5, 1.5}, {0.0, 2.0}}) {
        atoms.positions.emplace_back(corner + Eigen::Vector3d(u * width, v * bond, 0.0));
      }
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  atoms.box.cell = Eigen::Vector3d(nx * width, ny * height, 20.0).asDiagonal();
  atoms.box.periodic = {true, true, false};
  return atoms;
}

/// Periodic diamond of n³ cubic cells of eight atoms [Å].
[[nodiscard]] inline potentials::Atoms diamond(int n, double lattice) {
  potentials::Atoms atoms;
  for (int cell = 0; cell < n * n * n; ++cell) {
    const Eigen::Vector3d corner(cell % n, cell / n % n, cell / n / n);
    for (const Eigen::Vector3d& face :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0.5, 0.5), Eigen::Vector3d(0.5, 0, 0.5),
          Eigen::Vector3d(0.5, 0.5, 0)}) {
      atoms.positions.emplace_back(lattice * (corner + face));
      atoms.positions.emplace_back(lattice * (corner + face + Eigen::Vector3d::Constant(0.25)));
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  atoms.box = periodic(cube(n * lattice));
  return atoms;
}

/// Dual of the geodesic sphere that cuts each edge of an icosahedron `frequency` times: a closed
/// shell of 20 frequency² carbons with twelve pentagons, bonds within some percent of `bond` [Å].
[[nodiscard]] inline potentials::Atoms geodesic_shell(int frequency, double bond) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Eigen::Vector3d> corners;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-golden, golden}) {
      corners.insert(corners.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
    }
  }
  // Edges of this icosahedron are 2 long.
  const auto is_edge = [&](std::size_t a, std::size_t b) {
    return std::abs((corners[a] - corners[b]).norm() - 2.0) < 0.1;
  };
  const double area_of_atom = 0.75 * std::sqrt(3.0) * bond * bond;
  const double count = 20.0 * frequency * frequency;
  const double radius = std::sqrt(count * area_of_atom / (4.0 * std::numbers::pi));
  potentials::Atoms atoms;
  const auto add_face = [&](const Eigen::Matrix3d& face) {
    const auto vertex = [&](int i, int j) -> Eigen::Vector3d {
      return (face * Eigen::Vector3d(frequency - i - j, i, j)).normalized();
    };
    const auto add_triangle = [&](const Eigen::Vector3d& sum) {
      atoms.positions.emplace_back(radius * sum.normalized());
    };
    for (int i = 0; i < frequency; ++i) {
      for (int j = 0; i + j < frequency; ++j) {
        add_triangle(vertex(i, j) + vertex(i + 1, j) + vertex(i, j + 1));
        if (i + j + 1 == frequency) continue;
        add_triangle(vertex(i + 1, j) + vertex(i + 1, j + 1) + vertex(i, j + 1));
      }
    }
  };
  for (std::size_t a = 0; a < 12; ++a) {
    for (std::size_t b = a + 1; b < 12; ++b) {
      for (std::size_t c = b + 1; c < 12; ++c) {
        if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(a, c)) continue;
        Eigen::Matrix3d face;
        face << corners[a], corners[b], corners[c];
        add_face(face);
      }
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  return atoms;
}

/// The leapfrog of a geodesic shell: a closed shell of 60 frequency² carbons with twelve pentagons.
/// Frequency 1 makes C60, 2 C240, 3 C540.
[[nodiscard]] inline potentials::Atoms leapfrog_shell(int frequency, double bond) {
  const potentials::Atoms parent = geodesic_shell(frequency, bond);
  potentials::Atoms atoms;
  for (const potentials::Bond& edge : potentials::bonds_within(parent, 1.3 * bond)) {
    const Eigen::Vector3d& a = parent.positions[edge.first];
    const Eigen::Vector3d& b = parent.positions[edge.second];
    // One atom on either side of each bond, a third of the way to the middle of the ring.
    const Eigen::Vector3d middle = 0.5 * (a + b);
    const Eigen::Vector3d aside =
        (b - a).cross(middle).normalized() * (b - a).norm() / std::sqrt(12.0);
    for (const double side : {-1.0, 1.0}) {
      atoms.positions.emplace_back(std::sqrt(3.0) * (middle + side * aside));
    }
  }
  atoms.species.assign(atoms.positions.size(), potentials::Species::carbon);
  return atoms;
}

/// Graphene rolled up, periodic along z: n hexagons around and `periods` periods along, armchair
/// (n, n) or zigzag (n, 0).
enum class Chirality { armchair, zigzag };
[[nodiscard]] inline potentials::Atoms nanotube(Chirality chirality, int n, int periods,
                                                double bond) {
  const bool is_zigzag = chirality == Chirality::zigzag;
  const potentials::Atoms sheet =
      is_zigzag ? graphene(n, periods, bond) : graphene(periods, n, bond);
  const int around = is_zigzag ? 0 : 1;
  const double radius = sheet.box.cell(around, around) / (2.0 * std::numbers::pi);
  potentials::Atoms atoms = sheet;
  for (Eigen::Vector3d& x : atoms.positions) {
    const double angle = x[around] / radius;
    x = {radius * std::cos(angle), radius * std::sin(angle), x[1 - around]};
  }
  atoms.box.cell =
      Eigen::Vector3d(100.0, 100.0, sheet.box.cell(1 - around, 1 - around)).asDiagonal();
  atoms.box.periodic = {false, false, true};
  return atoms;
}

/// Ethane-like: two carbons and six hydrogens, none of them at rest [Å].
[[nodiscard]] inline potentials::Atoms bent_ethane() {
  potentials::Atoms atoms;
  atoms.positions = {{0.00, 0.02, -0.76},  {0.03, 0.00, 0.77},  {1.05, 0.01, 1.16},
                     {-0.50, -0.93, 1.15}, {-0.52, 0.87, 1.14}, {0.51, 0.90, -1.18},
                     {0.55, -0.86, -1.16}, {-1.02, 0.00, -1.12}};
  atoms.species.assign(8, potentials::Species::hydrogen);
  atoms.species[0] = atoms.species[1] = potentials::Species::carbon;
  return atoms;
}

/// Carbon and hydrogen at random, no two nearer than `apart` [Å].
[[nodiscard]] inline potentials::Atoms random_hydrocarbon(std::size_t count,
                                                          const potentials::Box& box, double apart,
                                                          unsigned seed) {
  std::mt19937 generator(seed);
  potentials::Atoms atoms;
  atoms.box = box;
  for (unsigned attempt = 0; atoms.size() < count && attempt < 100000; ++attempt) {
    const Eigen::Vector3d x = random_gas(1, box, static_cast<unsigned>(generator())).positions[0];
    bool is_free = true;
    for (const Eigen::Vector3d& other : atoms.positions) {
      Eigen::Vector3d between = box.cell.inverse() * (x - other);
      if (box.is_periodic()) between -= between.array().round().matrix();
      is_free = is_free && (box.cell * between).norm() > apart;
    }
    if (!is_free) continue;
    atoms.positions.push_back(x);
    atoms.species.push_back(generator() % 3 == 0 ? potentials::Species::hydrogen
                                                 : potentials::Species::carbon);
  }
  return atoms;
}

}  // namespace trivalent::testing_support
