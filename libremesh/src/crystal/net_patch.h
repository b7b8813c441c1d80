#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "crystal/spring_step.h"
#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// One change of the connectivity, between vertices of a patch.
struct PatchChange {
  enum class Kind : std::uint8_t { flip, collapse, split } kind;
  /// flip, split: the edge. collapse: `from` is removed, `to` stays.
  std::uint8_t from;
  std::uint8_t to;
};

/// Room for marks on the vertices of a mesh while patches are cut out of it.
class PatchMarks {
 public:
  /// Local number of a vertex in the patch at hand, or -1.
  [[nodiscard]] int number(VertexHandle v) const {
    const auto i = index(v);
    return i < stamp_.size() && stamp_[i] == now_ ? number_[i] : -1;
  }
  void begin(std::size_t n_vertices) {
    if (stamp_.size() < n_vertices) {
      stamp_.resize(n_vertices, 0);
      number_.resize(n_vertices, 0);
    }
    ++now_;
  }
  void set(VertexHandle v, int number) {
    stamp_[index(v)] = now_;
    number_[index(v)] = number;
  }

 private:
  std::vector<std::uint32_t> stamp_;
  std::vector<int> number_;
  std::uint32_t now_ = 0;
};

/// A piece cut out of a mesh: a vertex and the rings around it, whose connectivity can be changed
/// and whose vertices can move in their tangent planes, while the outermost ring stays fixed. What
/// a move costs is found out here, without touching the mesh; many patches are tried in parallel.
class NetPatch {
 public:
  static constexpr int capacity = 112;
  static constexpr int most_neighbors = 8;

  /// Cuts out the vertices up to `rings` + 1 edges from the center; the last ring is fixed.
  ///
  /// @param frames  Where every vertex of the mesh may move, by its number.
  NetPatch(const ConstrainedMesh& constrained, const std::vector<MotionFrame>& frames,
           VertexHandle center, int rings, PatchMarks& marks);

  /// False if the patch did not fit.
  [[nodiscard]] bool is_whole() const { return whole_; }
  [[nodiscard]] int size() const { return count_; }
  /// Vertices at most so many edges from the center.
  [[nodiscard]] int count_within(int ring) const { return ring_end_[at(ring)]; }
  /// Invalid for a vertex that a split has made.
  [[nodiscard]] VertexHandle vertex(int i) const { return vertex_[at(i)]; }
  void set_position(int i, const Eigen::Vector3d& p) { place_[at(i)] = in_lanes(p - origin_); }
  [[nodiscard]] Eigen::Vector3d position(int i) const {
    return origin_ + place_[at(i)].cast<double>().head<3>();
  }
  [[nodiscard]] bool is_free(int i) const { return mobility_[at(i)] > 0 && valence_[at(i)] > 0; }
  [[nodiscard]] int valence(int i) const { return valence_[at(i)]; }
  /// Valence minus what it should be: 6, or 4 on a boundary.
  [[nodiscard]] int deviation(int i) const { return valence_[at(i)] - goal_[at(i)]; }
  [[nodiscard]] int neighbor(int i, int k) const { return ring_[at(i)][at(k)]; }
  [[nodiscard]] const std::vector<PatchChange>& changes() const { return changes_; }

  /// Σ (valence - 6)² over the vertices inside; less on a boundary.
  [[nodiscard]] int disorder() const;

  /// Each returns false, and changes nothing, if the result would not be a manifold, would leave a
  /// feature curve, or would reach beyond the patch.
  bool flip(int a, int b);
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
  using Ring = std::array<std::uint8_t, most_neighbors>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] int place_in_ring(int v, int neighbor) const;
  [[nodiscard]] int next_in_ring(int v, int neighbor) const;
  [[nodiscard]] int previous_in_ring(int v, int neighbor) const;
  void remove_from_ring(int v, int neighbor);
  void insert_after(int v, int neighbor, int inserted);
  [[nodiscard]] bool is_inside(int v) const { return valence_[at(v)] > 0; }
  [[nodiscard]] bool is_rigid(int a, int b) const {
    return on_feature_[at(a)] && on_feature_[at(b)];
  }

  /// A vector and 0: a processor's register.
  using Vector = Eigen::Vector4f;
  static Vector in_lanes(const Eigen::Vector3d& v) {
    return Eigen::Vector4d(v.x(), v.y(), v.z(), 0.0).cast<float>();
  }
  [[nodiscard]] Vector spring_step(int i, float rest) const;

  int count_ = 0;
  bool whole_ = true;
  std::array<int, 8> ring_end_;
  std::array<VertexHandle, capacity> vertex_;
  Eigen::Vector3d origin_;
  std::array<Vector, capacity> place_;  ///< positions, seen from the origin
  std::array<Vector, capacity> normal_;
  std::array<Vector, capacity> first_;  ///< tangent directions
  std::array<Vector, capacity> second_;
  std::array<std::uint8_t, capacity> mobility_;  ///< 2: tangent plane, 1: curve, 0: fixed
  std::array<bool, capacity> on_feature_;
  std::array<bool, capacity> open_;             ///< the ring is not closed: on a boundary
  std::array<std::uint8_t, capacity> valence_;  ///< 0: fixed or removed
  std::array<std::int8_t, capacity> goal_;
  std::array<Ring, capacity> ring_;  ///< counter-clockwise
  std::vector<PatchChange> changes_;
};

}  // namespace trivalent::remesh
