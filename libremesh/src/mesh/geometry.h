#pragma once

#include <Eigen/Geometry>
#include <array>

#include "trivalent/remesh/mesh.h"

/// Lengths, areas and directions of the elements of a mesh. All of libremesh asks here, so that
/// where elements lie in space, and through which boundary of a cell they reach, is known here
/// only.
namespace trivalent::remesh {

// ---- edges -------------------------------------------------------------------------------------

/// From vertex a to vertex b, which share an edge or a face.
[[nodiscard]] inline Eigen::Vector3d vector_between(const TriMesh& mesh, VertexHandle a,
                                                    VertexHandle b) {
  return mesh.point(b) - mesh.point(a);
}

[[nodiscard]] inline Eigen::Vector3d edge_vector(const TriMesh& mesh, HalfedgeHandle h) {
  return vector_between(mesh, mesh.from_vertex_handle(h), mesh.to_vertex_handle(h));
}

[[nodiscard]] inline double edge_length(const TriMesh& mesh, EdgeHandle e) {
  return mesh.calc_edge_length(e);
}

/// Of a halfedge's edge.
[[nodiscard]] inline double squared_length(const TriMesh& mesh, HalfedgeHandle h) {
  return mesh.calc_edge_sqr_length(h);
}

/// The middle of two vertices that share an edge.
[[nodiscard]] inline Eigen::Vector3d midpoint(const TriMesh& mesh, VertexHandle a, VertexHandle b) {
  return 0.5 * (mesh.point(a) + mesh.point(b));
}

/// Angle between the normals of an edge's two faces [rad], > 0 where the surface is convex.
[[nodiscard]] inline double dihedral_angle(const TriMesh& mesh, EdgeHandle e) {
  return mesh.calc_dihedral_angle(e);
}

// ---- faces -------------------------------------------------------------------------------------

/// Corners of a face next to each other in space, counter-clockwise.
[[nodiscard]] inline std::array<Eigen::Vector3d, 3> corners_of(const TriMesh& mesh, FaceHandle f) {
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t k = 0;
  for (const auto v : mesh.fv_range(f)) corners[k++] = mesh.point(v);
  return corners;
}

[[nodiscard]] inline Eigen::Vector3d face_centroid(const TriMesh& mesh, FaceHandle f) {
  return mesh.calc_face_centroid(f);
}

[[nodiscard]] inline double face_area(const TriMesh& mesh, FaceHandle f) {
  return mesh.calc_face_area(f);
}

/// Unit normal; not finite for a face without an area.
[[nodiscard]] inline Eigen::Vector3d face_normal(const TriMesh& mesh, FaceHandle f) {
  return mesh.calc_normal(f);
}

/// Angle of a face at the vertex that the halfedge points to [rad]; may not be finite.
[[nodiscard]] inline double corner_angle(const TriMesh& mesh, HalfedgeHandle h) {
  return mesh.calc_sector_angle(h);
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

/// Twice the area of a triangle, along its normal.
[[nodiscard]] inline Eigen::Vector3d doubled_area_vector(const Eigen::Vector3d& a,
                                                         const Eigen::Vector3d& b,
                                                         const Eigen::Vector3d& c) {
  return (b - a).cross(c - a);
}

}  // namespace trivalent::remesh
