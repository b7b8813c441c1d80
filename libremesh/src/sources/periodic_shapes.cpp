#include <algorithm>
#include <cmath>
#include <numbers>

#include "sources/built_in_shapes.h"
#include "sources/implicit_surface.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

/// A function of the phases 2π x/a, 2π y/a, 2π z/a and its gradient by them.
struct Nodal {
  double value;
  Eigen::Vector3d gradient;
};

/// Sines and cosines of the phases of a point.
struct Waves {
  Eigen::Array3d s;
  Eigen::Array3d c;
};

/// The level set 0 of a sum of waves, which approximates a minimal surface [Schnering1991].
///
/// @param area  Of the surface in a cell of edge 1.
template <typename Function>
TriMesh nodal_surface(const Request& request, double area, const Function& function) {
  check_positive(request, {"a"});
  const double a = request.at("a");
  check_face_count(request, area * a * a);
  // The necks must be resolved by the grid.
  (void)pieces(request, a, request.edge_length, 8);
  const double wave_number = 2.0 * pi / a;
  const auto value = [=](const Eigen::Vector3d& p) {
    const Eigen::Array3d phase = wave_number * p.array();
    const Nodal nodal = function(Waves{phase.sin(), phase.cos()});
    // About the distance, near the surface.
    constexpr double min_slope = 0.3;  // between necks it vanishes
    return nodal.value / (wave_number * std::max(nodal.gradient.norm(), min_slope));
  };
  const Lattice lattice(a * Eigen::Matrix3d::Identity(), {true, true, true});
  return polygonize({.value = value, .lattice = lattice}, request.edge_length);
}

}  // namespace

TriMesh schwarz_p(const Request& request) {
  return nodal_surface(request, 2.35, [](const Waves& w) {
    return Nodal{w.c.sum(), -w.s};
  });
}

TriMesh schwarz_d(const Request& request) {
  return nodal_surface(request, 3.84, [](const Waves& w) {
    const auto& [s, c] = w;
    return Nodal{c.prod() - s.prod(),
                 {-s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
                  -c[0] * s[1] * c[2] - s[0] * c[1] * s[2],
                  -c[0] * c[1] * s[2] - s[0] * s[1] * c[2]}};
  });
}

TriMesh gyroid(const Request& request) {
  return nodal_surface(request, 3.10, [](const Waves& w) {
    const auto& [s, c] = w;
    return Nodal{s[0] * c[1] + s[1] * c[2] + s[2] * c[0],
                 {c[0] * c[1] - s[2] * s[0], c[1] * c[2] - s[0] * s[1], c[2] * c[0] - s[1] * s[2]}};
  });
}

TriMesh i_wp(const Request& request) {
  return nodal_surface(request, 3.65, [](const Waves& w) {
    const auto& [s, c] = w;
    const Eigen::Array3d s2 = 2.0 * s * c;
    const Eigen::Array3d c2 = 2.0 * c.square() - 1.0;
    const Eigen::Vector3d others(c[1] + c[2], c[2] + c[0], c[0] + c[1]);
    return Nodal{2.0 * (c[0] * c[1] + c[1] * c[2] + c[2] * c[0]) - c2.sum(),
                 (-2.0 * s * others.array() + 2.0 * s2).matrix()};
  });
}

TriMesh neovius(const Request& request) {
  return nodal_surface(request, 3.55, [](const Waves& w) {
    const auto& [s, c] = w;
    const Eigen::Array3d others(c[1] * c[2], c[2] * c[0], c[0] * c[1]);
    return Nodal{3.0 * c.sum() + 4.0 * c.prod(), (-s * (3.0 + 4.0 * others)).matrix()};
  });
}

TriMesh plane(const Request& request) {
  check_positive(request, {"a", "b", "gamma"});
  const double a = request.at("a");
  const double b = request.at("b");
  const double gamma = request.at("gamma") * pi / 180.0;
  if (!(gamma < pi)) throw InvalidOption("make_shape: plane: gamma must be below 180 degrees");
  check_face_count(request, a * b * std::sin(gamma));
  const double room = 10.0 * request.edge_length;
  Lattice::Cell cell;
  cell << a, b * std::cos(gamma), 0.0,  //
      0.0, b * std::sin(gamma), 0.0,    //
      0.0, 0.0, room;
  return polygonize({.value = [](const Eigen::Vector3d& p) { return p.z(); },
                     .lattice = Lattice(cell, {true, true, false})},
                    request.edge_length);
}

TriMesh periodic_tube(const Request& request) {
  check_positive(request, {"radius", "length"});
  const double radius = request.at("radius");
  const double length = request.at("length");
  check_face_count(request, 2.0 * pi * radius * length);
  (void)pieces(request, 2.0 * pi * radius, request.edge_length, 6);
  const double width = 2.0 * radius + 4.0 * request.edge_length;
  const Eigen::Vector3d sides(width, width, length);
  return polygonize({.value =
                         [radius](const Eigen::Vector3d& p) {
                           return std::hypot(p.x(), p.y()) - radius;
                         },
                     .lattice = Lattice(sides.asDiagonal(), {false, false, true})},
                    request.edge_length);
}

TriMesh wave(const Request& request) {
  check_positive(request, {"a", "b"});
  const Eigen::Vector2d sides(request.at("a"), request.at("b"));
  const double amplitude = request.at("amplitude");
  const Eigen::Array2d wave_number = 2.0 * pi / sides.array();
  const double slope = std::abs(amplitude) * wave_number.matrix().norm();
  check_face_count(request, sides.prod() * std::hypot(1.0, slope));
  const auto value = [=](const Eigen::Vector3d& p) {
    const Eigen::Array2d phase = wave_number * p.head<2>().array();
    const Eigen::Array2d slopes =
        amplitude * wave_number * phase.cos() * phase.sin().reverse();
    const double height = amplitude * phase.sin().prod();
    return (p.z() - height) / std::sqrt(1.0 + slopes.square().sum());
  };
  const double room = 2.0 * std::abs(amplitude) + 10.0 * request.edge_length;
  const Eigen::Vector3d frame(sides.x(), sides.y(), room);
  return polygonize({.value = value, .lattice = Lattice(frame.asDiagonal(), {true, true, false})},
                    request.edge_length);
}

}  // namespace trivalent::remesh
