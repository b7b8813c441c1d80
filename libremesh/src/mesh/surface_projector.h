#pragma once

#include <Eigen/Core>
#include <memory>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A point of a surface and the face it lies on.
struct SurfacePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  int face = 0;
};

/// Nearest points and normals of a fixed triangle surface. Queries may run in parallel.
class SurfaceProjector {
 public:
  /// @throws InvalidMesh if no face of the surface has an area.
  explicit SurfaceProjector(const TriMesh& surface);
  ~SurfaceProjector();
  SurfaceProjector(SurfaceProjector&&) noexcept;
  SurfaceProjector& operator=(SurfaceProjector&&) noexcept;
  SurfaceProjector(const SurfaceProjector&) = delete;
  SurfaceProjector& operator=(const SurfaceProjector&) = delete;

  /// The point of the surface nearest to p.
  [[nodiscard]] SurfacePoint nearest(const Eigen::Vector3d& p) const;

  /// The same, quicker if the answer is near the given face.
  [[nodiscard]] SurfacePoint nearest(const Eigen::Vector3d& p, int face) const;

  /// The point of the surface where a walk from the given face comes to rest that goes from face to
  /// face, always nearer to p: on the sheet where it began, be another one as near as it may. Takes
  /// a few faces for a short way, and does not search.
  [[nodiscard]] SurfacePoint walk_towards(const Eigen::Vector3d& p, int face) const;

  /// Unit normal: the vertex normals interpolated over the face, as a smooth surface would have it.
  [[nodiscard]] Eigen::Vector3d normal(const SurfacePoint& p) const;
  [[nodiscard]] const Eigen::Vector3d& normal(VertexHandle v) const;

  /// How far it is from a vertex, straight inwards, to the other side of the surface; infinite if
  /// nothing is there that looks the other way.
  [[nodiscard]] double thickness(VertexHandle v) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivalent::remesh
