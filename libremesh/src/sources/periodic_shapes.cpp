#include <cmath>
#include <numbers>

#include "sources/built_in_shapes.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/level_set.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

/// Sines and cosines of the phases 2π x/a, 2π y/a, 2π z/a.
struct PhaseWaves {
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
  (void)pieces(request, a, request.edge_length, 18);
  const auto field = [=](const Eigen::Vector3d& p) {
    const Eigen::Array3d phase = 2.0 * pi / a * p.array();
    return function(PhaseWaves{phase.sin(), phase.cos()});
  };
  const Lattice lattice(a * Eigen::Matrix3d::Identity(), {true, true, true});
  return level_set(field, 0.0, lattice, request.edge_length);
}

/// Height over the surface that a frame leaves on both sides.
double room(const Request& request) { return 5.0 * request.edge_length; }

}  // namespace

TriMesh schwarz_p(const Request& request) {
  return nodal_surface(request, 2.35, [](const PhaseWaves& w) { return w.c.sum(); });
}

TriMesh schwarz_d(const Request& request) {
  return nodal_surface(request, 3.84, [](const PhaseWaves& w) { return w.c.prod() - w.s.prod(); });
}

TriMesh gyroid(const Request& request) {
  return nodal_surface(request, 3.10, [](const PhaseWaves& w) {
    return w.s[0] * w.c[1] + w.s[1] * w.c[2] + w.s[2] * w.c[0];
  });
}

TriMesh i_wp(const Request& request) {
  return nodal_surface(request, 3.65, [](const PhaseWaves& w) {
    const Eigen::Array3d doubled = 2.0 * w.c.square() - 1.0;
    return 2.0 * (w.c[0] * w.c[1] + w.c[1] * w.c[2] + w.c[2] * w.c[0]) - doubled.sum();
  });
}

TriMesh neovius(const Request& request) {
  return nodal_surface(request, 3.55,
                       [](const PhaseWaves& w) { return 3.0 * w.c.sum() + 4.0 * w.c.prod(); });
}

TriMesh plane(const Request& request) {
  check_positive(request, {"a", "b", "gamma"});
  const double a = request.at("a");
  const double b = request.at("b");
  const double gamma = request.at("gamma") * pi / 180.0;
  if (!(gamma < pi)) throw InvalidOption("make_shape: plane: gamma must be below 180 degrees");
  check_face_count(request, a * b * std::sin(gamma));
  Lattice::Cell cell;
  cell << a, b * std::cos(gamma), 0.0,  //
      0.0, b * std::sin(gamma), 0.0,    //
      0.0, 0.0, 2.0 * room(request);
  return level_set([](const Eigen::Vector3d& p) { return p.z(); }, 0.0,
                   Lattice(cell, {true, true, false}), request.edge_length);
}

TriMesh periodic_tube(const Request& request) {
  check_positive(request, {"radius", "length"});
  const double radius = request.at("radius");
  check_face_count(request, 2.0 * pi * radius * request.at("length"));
  (void)pieces(request, 2.0 * pi * radius, request.edge_length, 6);
  const double width = 2.0 * (radius + room(request));
  const Eigen::Vector3d frame(width, width, request.at("length"));
  return level_set([](const Eigen::Vector3d& p) { return std::hypot(p.x(), p.y()); }, radius,
                   Lattice(frame.asDiagonal(), {false, false, true}), request.edge_length);
}

TriMesh wave(const Request& request) {
  check_positive(request, {"a", "b"});
  const Eigen::Array2d sides(request.at("a"), request.at("b"));
  const double amplitude = request.at("amplitude");
  const Eigen::Array2d wave_number = 2.0 * pi / sides;
  check_face_count(request,
                   sides.prod() * std::hypot(1.0, amplitude * wave_number.matrix().norm()));
  const auto field = [=](const Eigen::Vector3d& p) {
    return p.z() - amplitude * (wave_number * p.head<2>().array()).sin().prod();
  };
  const Eigen::Vector3d frame(sides[0], sides[1], 2.0 * (std::abs(amplitude) + room(request)));
  return level_set(field, 0.0, Lattice(frame.asDiagonal(), {true, true, false}),
                   request.edge_length);
}

}  // namespace trivalent::remesh
