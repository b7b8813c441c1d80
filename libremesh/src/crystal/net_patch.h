#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "crystal/patch_topology.h"
#include "crystal/spring_step.h"
#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// A piece cut out of a mesh: a vertex and the rings around it, whose connectivity can be changed
/// and whose vertices can move in their tangent planes, while the outermost ring stays fixed. What
/// a move costs is found out here, without touching the mesh; many patches are tried in parallel.
class NetPatch {
 public:
  static constexpr int capacity = PatchTopology::capacity;

  /// Cuts out the vertices up to `rings` + 1 edges from the center; the last ring is fixed.
  ///
  /// @param frames  Where every vertex of the mesh may move, by its number.
  NetPatch(const ConstrainedMesh& constrained, const std::vector<MotionFrame>& frames,
           VertexHandle center, int rings, PatchMarks& marks);

  [[nodiscard]] const PatchTopology& topology() const { return topology_; }
  /// False if the patch did not fit, or reaches around a lattice to itself.
  [[nodiscard]] bool is_whole() const { return topology_.is_whole() && !meets_itself_; }
  void set_position(int i, const Eigen::Vector3d& p) { place_[at(i)] = in_lanes(p - origin_); }
  [[nodiscard]] Eigen::Vector3d position(int i) const {
    return origin_ + place_[at(i)].cast<double>().head<3>();
  }
  [[nodiscard]] bool is_free(int i) const { return mobility_[at(i)] > 0 && topology_.is_inside(i); }

  /// As those of PatchTopology; vertices go to the middle of the edge.
  bool flip(int a, int b) { return topology_.flip(a, b); }
  bool collapse(int removed, int kept);
  bool split(int a, int b);
  /// Flips edges for as long as that lowers the disorder.
  void mend_valences();

  /// Moves every vertex to the minimum of its edges' energy in turn.
  ///
  /// @param reach  Only the first so many vertices, and new ones, move.
  void relax(double length, int sweeps, int reach = capacity);
  /// Σ (|e|/L - 1)² over the edges with an end inside.
  [[nodiscard]] double strain(double length) const;
  /// Corners of faces that stand steeply on the surface there, look inwards or have hardly an area.
  [[nodiscard]] int steep_corners() const;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// A vector and 0: a processor's register.
  using Vector = Eigen::Vector4f;
  static Vector in_lanes(const Eigen::Vector3d& v) {
    return Eigen::Vector4d(v.x(), v.y(), v.z(), 0.0).cast<float>();
  }
  [[nodiscard]] Vector spring_step(int i, float rest) const;

  PatchTopology topology_;
  Eigen::Vector3d origin_;
  bool meets_itself_ = false;
  std::array<Vector, capacity> place_;  ///< positions, seen from the origin
  std::array<Vector, capacity> normal_;
  std::array<Vector, capacity> first_;  ///< tangent directions
  std::array<Vector, capacity> second_;
  std::array<std::uint8_t, capacity> mobility_;  ///< 2: tangent plane, 1: curve, 0: fixed
};

}  // namespace trivalent::remesh
