#include "crystal/tether_strength.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/adjacency.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/surface_shape.h"

namespace trivalent::remesh {

namespace {

/// 1/H for the root mean square of the mean curvature H: the radius of a sphere.
double mean_radius(const TriMesh& surface, double area) {
  double bending = bending_integral(surface);
  if (surface.lattice.is_periodic()) {
    // Minimal surfaces bend without mean curvature: ∫ k1² + k2² dA, of a sphere as large.
    const double gaussian = 2.0 * std::numbers::pi * euler_characteristic(surface);
    bending = 2.0 * (bending - 2.0 * gaussian);
  }
  return std::sqrt(4.0 * area / bending);
}

}  // namespace

TetherStrength tether_of(const CrystalOptions& options) {
  if (options.stiffness) {
    const double ratio = std::sqrt(*options.stiffness / tether_of({}).tether);
    return {.tether = *options.stiffness,
            .cover = tether_of({}).cover * ratio,
            .slack = tether_of({}).slack / ratio};
  }
  switch (options.follow) {
    case Follow::close:
      return {.tether = 0.02, .cover = 0.1, .slack = 2.0};
    case Follow::carbon:
      return {.tether = 0.006, .cover = 0.05, .slack = 4.0};
    case Follow::free:
      return {.tether = 0.002, .cover = 0.02, .slack = 6.0};
  }
  throw InvalidOption("crystallize: unknown strength of following");
}

bool is_held(const CrystalOptions& options) {
  return options.stiffness || options.follow == Follow::close;
}

double size_of_component(const TriMesh& surface) {
  const auto components = static_cast<double>(find_components(surface).parts.size());
  return std::sqrt(surface_area(surface) / components);
}

double tether_factor(const TriMesh& surface, double area) {
  const double radius = mean_radius(surface, area);
  // Rough shapes have smaller radii of curvature than their size allows for.
  constexpr double sides_of_radius = 7.0;  // √area of smooth shapes, at most
  const double size = size_of_component(surface) / sides_of_radius;
  // Buckling by a given part of the radius costs the tether R⁴, and gains what scars of pairs cost,
  // R: without this, spheres of more than 10,000 atoms keep their scars. On a sphere of 20,000
  // atoms an exponent of 4 leaves fewer of them than 3. An open sheet that nothing holds flattens.
  constexpr double large = 40.0;  // [Å]
  const double of_radius = std::pow(large / std::max(radius, large), 4.0);
  // The bumps of a rough surface ask for pairs of their own. With the square of the size, the bunny
  // of 200,000 atoms has 50 pentagons instead of 84; with the fourth power, ears are lost. The
  // tether forms what is wider than 2π (κ/k)^¼, where k is its stiffness per area: it stays as
  // stiff as thin arms need it. A periodic surface has no size of its own.
  constexpr double thin = 12.0;  // [Å]
  const double of_size =
      std::max(std::pow(large / std::max(size, large), 2.0), std::pow(thin / radius, 4.0));
  const double slackening =
      surface.lattice.is_periodic() ? of_radius : std::min(of_radius, of_size);
  if (slackening < 1.0) return has_boundary(surface) ? 1.0 : slackening;
  // A net that may leave a small shape by several Å takes another one, with defects of its own:
  // arms of a junction become a pyramid. Spheres of up to 960 atoms, tori, capsules, P and gyroid
  // have lower energies when they are held, a sphere of 2,160 atoms when it is not.
  constexpr double small = 21.0;  // [Å]
  constexpr double max_factor = 33.0;
  return std::clamp(std::pow(small / std::max(radius, size), 6.5), 1.0, max_factor);
}

}  // namespace trivalent::remesh
