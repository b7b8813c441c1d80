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

  /// Distance of p to the surface.
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const;

  /// The nearest point, faster if the answer is near the given face.
  [[nodiscard]] SurfacePoint nearest(const Eigen::Vector3d& p, int face) const;

  /// Walks over neighboring faces, always closer to p, and returns the local minimum; never leaves
  /// the sheet it began on. Cost: the faces on the way.
  [[nodiscard]] SurfacePoint walk_towards(const Eigen::Vector3d& p, int face) const;

  /// Unit normal: vertex normals interpolated over the face.
  [[nodiscard]] Eigen::Vector3d normal(const SurfacePoint& p) const;
  [[nodiscard]] const Eigen::Vector3d& normal(VertexHandle v) const;

  /// Distance from a vertex, straight inwards, to the other side of the surface; infinite if there
  /// is no face whose normal points away.
  [[nodiscard]] double thickness(VertexHandle v) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivalent::remesh
