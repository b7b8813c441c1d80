#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// One change of the connectivity, between vertices of a patch.
struct PatchChange {
  enum class Kind : std::uint8_t { flip, collapse, split } kind;
  /// flip, split: the edge. collapse: `from` is removed, `to` stays.
  std::uint8_t from;
  std::uint8_t to;
};

/// Numbers given to vertices of a mesh while patches are cut out of it.
class PatchMarks {
 public:
  /// Local number of a vertex in the current patch, or -1.
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

/// How far a patch reaches from its center [edges].
struct PatchReach {
  int inner;  ///< vertices up to here may change
  int known;  ///< one-rings are known up to here, >= inner; one more ring of vertices belongs to it
};

/// The connectivity of a piece of a mesh: a vertex and the rings around it. Moves are tried in it
/// without touching the mesh. Vertices are numbered by ring: inner ones first, then a free number
/// for the vertex that a split makes, then those that stay.
class PatchTopology {
 public:
  static constexpr int capacity = 240;
  static constexpr int max_valence = 8;
  /// Neighbors counter-clockwise, as many as the valence says.
  using Ring = std::array<std::uint8_t, max_valence>;
  static constexpr int max_rings = 8;

  /// Cuts a patch out of a mesh.
  PatchTopology(const ConstrainedMesh& constrained, VertexHandle center, PatchReach reach,
                PatchMarks& marks);

  /// False if the patch did not fit; nothing else is then valid.
  [[nodiscard]] bool is_whole() const { return whole_; }
  [[nodiscard]] int size() const { return count_; }
  /// Numbers below are inner vertices, removed ones, or the free number, which is the last of them.
  [[nodiscard]] int inner_count() const { return inner_; }
  [[nodiscard]] int added() const { return inner_ - 1; }
  /// Vertices at most so many edges from the center.
  [[nodiscard]] int count_within(int ring) const { return ring_end_[at(ring)]; }
  /// Invalid for the vertex that a split has made.
  [[nodiscard]] VertexHandle vertex(int i) const { return vertex_[at(i)]; }
  /// 0 for a vertex that was removed, is not there yet, or whose one-ring is not known.
  [[nodiscard]] int valence(int i) const { return valence_[at(i)]; }
  [[nodiscard]] bool is_inside(int i) const { return i < inner_ && valence_[at(i)] > 0; }
  /// Faces more than at first.
  [[nodiscard]] int added_faces() const { return added_faces_; }
  /// Valence minus what it should be: 6, or 4 on a boundary.
  [[nodiscard]] int deviation(int i) const { return valence_[at(i)] - goal_[at(i)]; }
  [[nodiscard]] int neighbor(int i, int k) const { return ring_[at(i)][at(k)]; }
  [[nodiscard]] const Ring& ring(int i) const { return ring_[at(i)]; }
  [[nodiscard]] bool is_neighbor(int i, int other) const { return place_in_ring(i, other) >= 0; }
  /// The neighbor that follows counter-clockwise, or -1 where the ring ends.
  [[nodiscard]] int next_in_ring(int v, int neighbor) const;
  [[nodiscard]] int previous_in_ring(int v, int neighbor) const;
  [[nodiscard]] bool is_open(int i) const { return open_[at(i)]; }
  [[nodiscard]] bool is_on_feature(int i) const { return on_feature_[at(i)]; }
  /// Edges between vertices on feature curves never change.
  [[nodiscard]] bool is_rigid(int a, int b) const {
    return on_feature_[at(a)] && on_feature_[at(b)];
  }
  [[nodiscard]] const std::vector<PatchChange>& changes() const { return changes_; }

  /// Σ (valence - 6)² over the inner vertices; less on a boundary.
  [[nodiscard]] int disorder() const;

  /// Each returns false, and changes nothing, if the result would not be a manifold, would leave a
  /// feature curve, or would reach beyond the inner vertices. At most one split. Vertices of a
  /// boundary are removed or added along it.
  bool flip(int a, int b);
  bool collapse(int removed, int kept);
  bool split(int a, int b);

  /// An edge whose flip lowers the disorder, and its ends; the largest decrease, then the smallest
  /// distance between the new ends.
  struct MendingFlip {
    int a;
    int b;
  };
  [[nodiscard]] std::optional<MendingFlip> mending_flip(
      const std::function<double(int, int)>& squared_distance) const;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void collect(const TriMesh& mesh, VertexHandle center, PatchReach reach, PatchMarks& marks);
  bool add(VertexHandle v, PatchMarks& marks);
  bool find_ring(const TriMesh& mesh, int i, const PatchMarks& marks);
  [[nodiscard]] int place_in_ring(int v, int neighbor) const;
  void remove_from_ring(int v, int neighbor);
  void insert_at(int v, int place, int inserted);
  void insert_after(int v, int neighbor, int inserted);
  void replace_in_ring(int v, int neighbor, int by);
  void record(PatchChange::Kind kind, int from, int to);
  [[nodiscard]] bool can_lose_edge(int v) const;
  /// @param third  The corner of the only face at the edge.
  [[nodiscard]] bool can_collapse_on_boundary(int removed, int kept, int third) const;
  bool collapse_on_boundary(int removed, int kept);
  bool split_on_boundary(int a, int b);
  [[nodiscard]] int gain_of_flip(int a, int b, int c, int d) const;

  int count_ = 0;
  int inner_ = 0;
  int added_faces_ = 0;
  bool whole_ = false;
  std::array<int, max_rings> ring_end_{};
  std::array<VertexHandle, capacity> vertex_;
  std::array<bool, capacity> on_feature_;
  std::array<bool, capacity> is_corner_;  ///< where feature curves end, meet or turn
  std::array<bool, capacity> open_;       ///< the ring is not closed: on a boundary
  std::array<std::uint8_t, capacity> valence_;
  std::array<std::int8_t, capacity> goal_;
  std::array<Ring, capacity> ring_;  ///< counter-clockwise
  std::vector<PatchChange> changes_;
};

/// Positions of the vertices of a new patch, side by side: in a lattice, of the images that edges
/// lead to from the center.
[[nodiscard]] std::vector<Eigen::Vector3d> unfolded_positions(const TriMesh& mesh,
                                                              const PatchTopology& topology);

/// Whether a patch reaches around the lattice to itself, so that an edge leads to another image of
/// a vertex than that at `positions`.
[[nodiscard]] bool meets_itself(const TriMesh& mesh, const PatchTopology& topology,
                                const std::vector<Eigen::Vector3d>& positions);

}  // namespace trivalent::remesh
