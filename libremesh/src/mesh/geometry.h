#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "trivalent/remesh/mesh.h"

/// Lengths, areas and directions of the elements of a mesh. All of libremesh asks here, so that
/// where elements lie in space, and through which boundary of a cell they reach, is known here
/// only.
namespace trivalent::remesh {

// ---- edges -------------------------------------------------------------------------------------

/// From vertex a to vertex b, which share an edge or a face.
[[nodiscard]] inline Eigen::Vector3d vector_between(const TriMesh& mesh, VertexHandle a,
                                                    VertexHandle b) {
  return mesh.lattice.nearest(mesh.point(b) - mesh.point(a));
}

/// Where vertex b is, seen from vertex a, which shares an edge or a face with it.
[[nodiscard]] inline Eigen::Vector3d position_beside(const TriMesh& mesh, VertexHandle a,
                                                     VertexHandle b) {
  return mesh.lattice.near(mesh.point(a), mesh.point(b));
}

[[nodiscard]] inline Eigen::Vector3d edge_vector(const TriMesh& mesh, HalfedgeHandle h) {
  return vector_between(mesh, mesh.from_vertex_handle(h), mesh.to_vertex_handle(h));
}

/// Of a halfedge's edge.
[[nodiscard]] inline double squared_length(const TriMesh& mesh, HalfedgeHandle h) {
  return edge_vector(mesh, h).squaredNorm();
}

[[nodiscard]] inline double edge_length(const TriMesh& mesh, EdgeHandle e) {
  return edge_vector(mesh, mesh.halfedge_handle(e, 0)).norm();
}

/// The middle of two vertices that share an edge, beside the first.
[[nodiscard]] inline Eigen::Vector3d midpoint(const TriMesh& mesh, VertexHandle a, VertexHandle b) {
  return 0.5 * (mesh.point(a) + position_beside(mesh, a, b));
}

// ---- faces -------------------------------------------------------------------------------------

/// Corners of a face next to each other in space, counter-clockwise.
[[nodiscard]] inline std::array<Eigen::Vector3d, 3> corners_of(const TriMesh& mesh, FaceHandle f) {
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t k = 0;
  for (const auto v : mesh.fv_range(f)) corners[k++] = mesh.point(v);
  for (k = 1; k < 3; ++k) corners[k] = mesh.lattice.near(corners[0], corners[k]);
  return corners;
}

/// Twice the area of a triangle, along its normal.
[[nodiscard]] inline Eigen::Vector3d doubled_area_vector(const Eigen::Vector3d& a,
                                                         const Eigen::Vector3d& b,
                                                         const Eigen::Vector3d& c) {
  return (b - a).cross(c - a);
}

[[nodiscard]] inline Eigen::Vector3d face_centroid(const TriMesh& mesh, FaceHandle f) {
  const auto [a, b, c] = corners_of(mesh, f);
  return (a + b + c) / 3.0;
}

[[nodiscard]] inline double face_area(const TriMesh& mesh, FaceHandle f) {
  const auto [a, b, c] = corners_of(mesh, f);
  return 0.5 * doubled_area_vector(a, b, c).norm();
}

/// Unit normal of a triangle; zero without an area.
[[nodiscard]] inline Eigen::Vector3d unit_normal(const std::array<Eigen::Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d n = doubled_area_vector(b, c, a);
  const double length = n.norm();
  return length > 0.0 ? Eigen::Vector3d(n * (1.0 / length)) : Eigen::Vector3d::Zero();
}

[[nodiscard]] inline Eigen::Vector3d face_normal(const TriMesh& mesh, FaceHandle f) {
  return unit_normal(corners_of(mesh, f));
}

/// Edges from the vertex that a halfedge points to: the next of its face, and its own back.
[[nodiscard]] inline std::array<Eigen::Vector3d, 2> corner_edges(const TriMesh& mesh,
                                                                 HalfedgeHandle h) {
  return {edge_vector(mesh, mesh.next_halfedge_handle(h)), -edge_vector(mesh, h)};
}

/// Angle of a face at the vertex that the halfedge points to [rad]; 0 where an edge is.
[[nodiscard]] inline double corner_angle(const TriMesh& mesh, HalfedgeHandle h) {
  const auto [a, b] = corner_edges(mesh, h);
  const double lengths = a.norm() * b.norm();
  return lengths > 0.0 ? std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0)) : 0.0;
}

/// Angle between the normals of an edge's two faces [rad], > 0 where the surface is convex; 0 on a
/// boundary and beside a face without an area.
[[nodiscard]] inline double dihedral_angle(const TriMesh& mesh, EdgeHandle e) {
  if (mesh.is_boundary(e)) return 0.0;
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  const auto [left_next, left_back] = corner_edges(mesh, h);
  const auto [right_next, right_back] = corner_edges(mesh, mesh.opposite_halfedge_handle(h));
  const Eigen::Vector3d left = left_next.cross(left_back);
  const Eigen::Vector3d right = right_next.cross(right_back);
  const double lengths = left.norm() * right.norm();
  if (!(lengths > 0.0)) return 0.0;
  const double angle = std::acos(std::clamp(left.dot(right) / lengths, -1.0, 1.0));
  return left.cross(right).dot(edge_vector(mesh, h)) < 0.0 ? -angle : angle;
}

/// Barycentric coordinates of a point in the plane of a triangle; not finite without an area.
[[nodiscard]] inline Eigen::Vector3d barycentric(const std::array<Eigen::Vector3d, 3>& triangle,
                                                 const Eigen::Vector3d& p) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  const double at_a = (b - p).cross(c - p).dot(normal) / area;
  const double at_b = (c - p).cross(a - p).dot(normal) / area;
  return {at_a, at_b, 1.0 - at_a - at_b};
}

}  // namespace trivalent::remesh
