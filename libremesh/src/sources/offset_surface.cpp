#include "trivalent/remesh/offset_surface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "mesh/surface_projector.h"
#include "sources/implicit_surface.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// Unit vectors across the periodic directions, one for each direction that is not periodic.
std::vector<Eigen::Vector3d> free_directions(const Lattice& lattice) {
  std::vector<Eigen::Vector3d> periodic;
  for (std::size_t k = 0; k < 3; ++k) {
    if (lattice.periodic()[k]) {
      periodic.emplace_back(lattice.cell().col(static_cast<Eigen::Index>(k)));
    }
  }
  if (periodic.size() == 3) return {};
  if (periodic.size() == 2) return {periodic[0].cross(periodic[1]).normalized()};
  const Eigen::Vector3d first = periodic[0].unitOrthogonal();
  return {first, periodic[0].cross(first).normalized()};
}

/// The cell, as wide as the surface and the room around it in the directions that are not periodic.
///
/// @param center  set to the middle of the surface in these directions
Lattice framed(const TriMesh& surface, double room, Eigen::Vector3d& center) {
  const Lattice& lattice = surface.lattice;
  Lattice::Cell cell = lattice.cell();
  center.setZero();
  const std::vector<Eigen::Vector3d> directions = free_directions(lattice);
  auto next = directions.begin();
  Eigen::Index last = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (lattice.periodic()[k]) continue;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto v : surface.vertices()) {
      const double along = next->dot(surface.point(v));
      low = std::min(low, along);
      high = std::max(high, along);
    }
    center += 0.5 * (low + high) * *next;
    last = static_cast<Eigen::Index>(k);
    cell.col(last) = (high - low + 2.0 * room) * *next;
    ++next;
  }
  // The grid of the polygonizer is right-handed.
  if (cell.determinant() < 0.0) cell.col(last) *= -1.0;
  return {cell, lattice.periodic()};
}

/// Distance of p from a surface, < 0 on the side from which its normals point away.
double signed_distance(const SurfaceProjector& projector, const Lattice& lattice,
                       const Eigen::Vector3d& p) {
  const SurfacePoint foot = projector.nearest(p);
  const Eigen::Vector3d away = p - lattice.near(p, foot.position);
  return away.dot(projector.normal(foot)) < 0.0 ? -away.norm() : away.norm();
}

/// The shortest step of a vertex that takes the planes of the faces around it to the distance:
/// along the normal where the surface is smooth, farther at creases and corners.
Eigen::Vector3d step_to_offset(const TriMesh& surface, VertexHandle v, double distance) {
  Eigen::Matrix3d planes = Eigen::Matrix3d::Zero();
  Eigen::Vector3d distances = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const auto h : surface.vih_range(v)) {
    if (h.is_boundary()) continue;
    const Eigen::Vector3d normal = face_normal(surface, h.face());
    const double weight = corner_angle(surface, h);
    planes += weight * normal * normal.transpose();
    distances += weight * distance * normal;
    weights += weight;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(planes);
  constexpr double hardly_bent = 0.02;  // two planes at 16 degrees: the normal is good enough
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const double strength = solver.eigenvalues()[k];
    const Eigen::Vector3d direction = solver.eigenvectors().col(k);
    if (strength > hardly_bent * weights) step += direction.dot(distances) / strength * direction;
  }
  return step;
}

/// The offset of a surface with a boundary.
TriMesh moved_sheet(const TriMesh& surface, double distance) {
  const SurfaceProjector projector(surface);
  TriMesh moved = surface;
  for (const auto v : surface.vertices()) {
    moved.point(v) += step_to_offset(surface, v, distance);
    constexpr double slack = 0.9;
    if (projector.distance(moved.point(v)) < slack * std::abs(distance)) {
      throw InvalidMesh("offset_surface: the offset touches itself");
    }
  }
  for (const auto f : surface.faces()) {
    const Eigen::Vector3d before = face_normal(surface, f);
    const bool has_area = !before.isZero(0.0);
    if (has_area && face_normal(moved, f).dot(before) <= 0.0) {
      throw InvalidMesh("offset_surface: the offset would be turned inside out");
    }
  }
  return moved;
}

}  // namespace

TriMesh offset_surface(const TriMesh& surface, double distance, double edge_length) {
  if (has_boundary(surface)) return moved_sheet(surface, distance);
  const SurfaceProjector projector(surface);
  const double room = std::abs(distance) + 4.0 * edge_length;
  ImplicitSurface offset;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  if (surface.lattice.is_periodic()) {
    offset.lattice = framed(surface, room, center);
  } else {
    offset.box = bounding_box(surface);
    offset.box.low.array() -= room;
    offset.box.high.array() += room;
  }
  offset.value = [&](const Eigen::Vector3d& from_center) {
    return signed_distance(projector, surface.lattice, center + from_center) - distance;
  };
  TriMesh mesh = polygonize_any(std::move(offset), edge_length);
  for (const auto v : mesh.vertices()) mesh.point(v) += center;
  mesh.lattice = surface.lattice;
  return mesh;
}

TriMesh surface_in_lattice(const TriMesh& surface, const Lattice& lattice) {
  if (has_boundary(surface)) throw InvalidMesh("surface_in_lattice: the surface has a boundary");
  const SurfaceProjector projector(surface);
  ImplicitSurface anew;
  anew.lattice = lattice;
  anew.value = [&](const Eigen::Vector3d& p) {
    return signed_distance(projector, surface.lattice, p);
  };
  return polygonize_any(std::move(anew), mean_edge_length(surface));
}

}  // namespace trivalent::remesh
