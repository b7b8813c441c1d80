#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "mesh/lattice_vector.h"

namespace trivalent::remesh {

/// The disclinations of a closed net, joined by large triangles that are flat in the net's own
/// metric, where every edge has length 1 [Thurston1998]. The sides of a triangle are vectors of the
/// lattice. They say where the disclinations lie, and all of the net follows from that. In this
/// metric disclinations are the tips of cones.
///
/// Half-edges 3t, 3t + 1 and 3t + 2 go around triangle t, counter-clockwise, each triangle in a
/// frame of its own. Two disclinations may be joined several times.
class ConeNet {
 public:
  /// A vertex of the net, in the frame of a large triangle whose first corner is the origin.
  struct Place {
    int triangle;
    LatticeVector at;
  };

  /// @param triangles   Of a closed net.
  /// @param n_vertices  Each has a triangle.
  ConeNet(std::span<const std::array<int, 3>> triangles, std::size_t n_vertices);

  [[nodiscard]] int n_halfedges() const { return static_cast<int>(halfedges_.size()); }
  [[nodiscard]] int to(int h) const { return at(h).to; }
  [[nodiscard]] int from(int h) const { return at(previous(h)).to; }
  [[nodiscard]] int opposite(int h) const { return at(h).opposite; }
  [[nodiscard]] const LatticeVector& side(int h) const { return at(h).side; }
  [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// Of the net.
  [[nodiscard]] std::int64_t n_faces() const;

  /// Moves the disclination that a half-edge begins at by a vector in the frame of its triangle,
  /// and the one that it ends at by as much as leaves all others where they are: a dislocation
  /// goes from one to the other.
  ///
  /// @return  False, with nothing done, if the other one would leave the lattice, or if a large
  ///   triangle would turn over.
  bool move(int halfedge, const LatticeVector& by);
  /// The half-edges whose sides such a move changes, in ascending order.
  [[nodiscard]] std::span<const int> sides_moved_with(int halfedge) const {
    return motions_[static_cast<std::size_t>(halfedge)].sides;
  }
  /// The first half-edges of the triangles that it changes, in ascending order.
  [[nodiscard]] std::span<const int> triangles_moved_with(int halfedge) const {
    return motions_[static_cast<std::size_t>(halfedge)].triangles;
  }

  /// How a side changes with a move.
  struct SideChange {
    int halfedge;
    std::complex<double> factor;  ///< of the vector that the first disclination moves by
  };
  /// Of a move by any vector of the plane. Empty if there is none.
  [[nodiscard]] std::vector<SideChange> side_changes(int halfedge) const;

  /// The same disclinations with all sides so many times as long.
  [[nodiscard]] ConeNet enlarged(int times) const;

  /// The net that the sides belong to.
  struct Net {
    std::vector<std::array<int, 3>> triangles;
    std::vector<Place> places;  ///< of its vertices
    /// Of each triangle: the large one that its center is in, and the edge between its first two
    /// corners in that frame.
    std::vector<Place> first_edges;
  };
  [[nodiscard]] Net net() const;

  /// Where a vertex of a moved net comes from in this one: a mean of three of its vertices.
  struct Mean {
    std::array<int, 3> vertices;
    std::array<double, 3> weights;
  };
  /// @param moved  This net, but for moves. This one has not been moved itself.
  [[nodiscard]] Mean mean_at(const ConeNet& moved, const Place& place) const;
  /// The point at part/parts of a side.
  [[nodiscard]] Mean mean_on_side(int h, int part, int parts) const;

 private:
  struct Halfedge {
    int to;
    int opposite;
    LatticeVector side;
  };
  /// A vertex of the net this was made of, in a large triangle.
  struct Inside {
    int vertex;
    LatticeVector at;
  };
  /// How a side changes with a move: its factor as a complex number, of the vector that one of the
  /// two disclinations moves by.
  struct Step {
    int halfedge;
    bool is_of_end;
    LatticeVector factor;
  };
  /// What moves with the two ends of a half-edge.
  struct Motion {
    LatticeVector numerator = LatticeVector::Zero();  ///< of the end's vector, by the beginning's
    LatticeVector denominator = LatticeVector::Zero();
    std::optional<LatticeVector> ratio;  ///< of the two, if the lattice has it
    std::vector<Step> steps;
    std::vector<int> sides;
    std::vector<int> triangles;
  };
  /// A triangle of the lattice, in the frame of a large one.
  struct Small {
    LatticeVector center;  ///< three times as large
    std::array<LatticeVector, 3> corners;
  };
  /// Places that are equal have equal keys.
  using Key = std::array<std::int64_t, 3>;

  [[nodiscard]] const Halfedge& at(int h) const { return halfedges_[static_cast<std::size_t>(h)]; }
  [[nodiscard]] Halfedge& at(int h) { return halfedges_[static_cast<std::size_t>(h)]; }
  [[nodiscard]] LatticeVector corner(int h) const;
  [[nodiscard]] int turn(int h) const;
  [[nodiscard]] Place across(int h, const LatticeVector& q, std::int64_t scale) const;
  [[nodiscard]] Place walk(Place from, LatticeVector to, std::int64_t scale) const;
  [[nodiscard]] Key key_of(const Place& place) const;
  [[nodiscard]] bool owns(int triangle, const LatticeVector& p) const;
  [[nodiscard]] std::vector<Small> triangles_in(int triangle) const;
  [[nodiscard]] Mean mean_of(const Place& place, std::int64_t scale) const;

  [[nodiscard]] Motion motion_of(int halfedge) const;
  void link(std::span<const std::array<int, 3>> triangles);
  [[nodiscard]] int degree_of(int outgoing) const;
  [[nodiscard]] bool is_inside_star(int outgoing) const;
  bool flip(int h, int min_area = 1);
  bool remove_vertex(int outgoing);
  bool lower_degree(int v, int degree);
  void remove_flat_vertices(std::span<const int> valences);
  void make_delaunay();
  void drop_removed();
  void number_vertices();

  std::vector<Halfedge> halfedges_;
  std::vector<Motion> motions_;              // of every half-edge
  std::vector<std::vector<Inside>> inside_;  // of each large triangle
  std::vector<int> outgoing_;                // a half-edge of each vertex while they are removed
  std::map<Key, int> vertex_at_;             // of the net this was made of
};

}  // namespace trivalent::remesh
