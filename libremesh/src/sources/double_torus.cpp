#include <algorithm>
#include <cmath>
#include <numbers>

#include "sources/built_in_shapes.h"
#include "sources/implicit_surface.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

double distance_to_torus(const Eigen::Vector3d& p, double R, double r) {
  return std::hypot(std::hypot(p.x(), p.y()) - R, p.z()) - r;
}

}  // namespace

TriMesh double_torus(const Request& request) {
  check_positive(request, {"R", "r"});
  const double R = request.at("R");
  const double r = request.at("r");
  // Thicker tubes, blended, would close the holes.
  if (r > 0.6 * R) {
    throw InvalidOption(
        concat("make_shape: double-torus: r = ", r, " must be at most 0.6 R = ", 0.6 * R));
  }
  check_face_count(request, 8.0 * pi * pi * R * r);
  // The tubes must be resolved by the lattice.
  (void)pieces(request, 2.0 * pi * r, request.edge_length, 6);
  // Two tori that touch along their center lines, joined by a smooth minimum of their distances. A
  // weighted mean of gradients of length 1 is no longer than 1, as polygonize() demands.
  const double blend = 0.25 * r;
  const auto value = [=](const Eigen::Vector3d& p) {
    const Eigen::Vector3d center(R, 0.0, 0.0);
    const double a = distance_to_torus(p - center, R, r);
    const double b = distance_to_torus(p + center, R, r);
    return std::min(a, b) - blend * std::log1p(std::exp(-std::abs(a - b) / blend));
  };
  const double room = r + blend + 2.0 * request.edge_length;
  const Eigen::Vector3d high(2.0 * R + room, R + room, room);
  return polygonize({value, {-high, high}}, request.edge_length);
}

}  // namespace trivalent::remesh
