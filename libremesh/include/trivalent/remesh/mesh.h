#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// After the kernel: it specializes the kernel's vector traits.
#include <Eigen/Core>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "trivalent/remesh/lattice.h"

namespace trivalent::remesh {

/// OpenMesh with double-precision Eigen vectors and deletion flags.
struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
  using TexCoord2D = Eigen::Vector2d;
  VertexAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};

/// Half-edge triangle mesh. Every TriMesh passed to or from this library is garbage collected: no
/// element is marked as deleted.
///
/// A periodic surface has a lattice: vertices stand for all of their images, edges lead to the
/// nearest one, and positions may lie in any cell.
struct TriMesh : OpenMesh::TriMesh_ArrayKernelT<MeshTraits> {
  Lattice lattice;
};
using VertexHandle = OpenMesh::VertexHandle;
using EdgeHandle = OpenMesh::EdgeHandle;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using FaceHandle = OpenMesh::FaceHandle;

/// Area of the equilateral triangle of edge 1.
inline constexpr double unit_triangle_area = 0.25 * std::numbers::sqrt3;

/// Maximum number of faces that remesh() and make_shape() make: more would not fit into the memory
/// of most machines, at about 1 kB per face.
inline constexpr double max_faces = 2e7;

/// Position of a vertex in arrays with one entry per vertex.
[[nodiscard]] inline std::size_t index(int number) { return static_cast<std::size_t>(number); }
[[nodiscard]] inline std::size_t index(VertexHandle v) { return index(v.idx()); }

/// Builds a half-edge mesh from points and triangles (indices into points, counter-clockwise seen
/// from outside). Points that no triangle uses stay as isolated vertices.
///
/// @throws InvalidMesh if a coordinate is not finite, an index is out of range, a triangle repeats
///   a corner, or the triangles form no oriented 2-manifold; the message names the element.
[[nodiscard]] TriMesh make_mesh(std::span<const Eigen::Vector3d> points,
                                std::span<const std::array<int, 3>> triangles);

/// Vertices - edges + faces: 2 for a sphere, 0 for a torus.
[[nodiscard]] int euler_characteristic(const TriMesh& mesh);

/// Corner indices of every face, in face order.
[[nodiscard]] std::vector<std::array<int, 3>> triangles_of(const TriMesh& mesh);

/// Mean edge length, in the mesh's own unit; 0 for a mesh without edges.
[[nodiscard]] double mean_edge_length(const TriMesh& mesh);

/// Sum of the face areas, in the mesh's unit squared.
[[nodiscard]] double surface_area(const TriMesh& mesh);

/// Centroid of every face, in face order; of a periodic surface within the cell.
[[nodiscard]] std::vector<Eigen::Vector3d> face_centroids(const TriMesh& mesh);

/// Lower and upper corner of the axis-aligned bounding box; the mesh must have a vertex.
struct BoundingBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  [[nodiscard]] double diagonal() const { return (high - low).norm(); }
  [[nodiscard]] double longest_side() const { return (high - low).maxCoeff(); }
};
[[nodiscard]] BoundingBox bounding_box(const TriMesh& mesh);

/// Multiplies every position, and the lattice, by factor.
void scale(TriMesh& mesh, double factor);

}  // namespace trivalent::remesh
