#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A closed triangulation of a periodic surface whose half-edges know which image of a vertex they
/// go to. Two vertices may be neighbors several times, through different images: a net of twenty
/// vertices is no mesh.
///
/// Half-edges 3t, 3t + 1 and 3t + 2 go around triangle t, counter-clockwise.
class CellNet {
 public:
  using Image = Lattice::Image;
  /// A vertex, and so many cell vectors.
  struct Corner {
    int vertex;
    Image image = {0, 0, 0};
  };
  using Triangle = std::array<Corner, 3>;

  /// @param positions  Of the vertices at image 0.
  /// @param triangles  Any image of each; every edge has two.
  CellNet(std::vector<Eigen::Vector3d> positions, const std::vector<Triangle>& triangles);

  /// @param mesh  Without boundary and deleted elements.
  [[nodiscard]] static CellNet of(const TriMesh& mesh);

  std::vector<Eigen::Vector3d> positions;

  [[nodiscard]] int n_vertices() const { return static_cast<int>(positions.size()); }
  [[nodiscard]] int n_halfedges() const { return static_cast<int>(halfedges_.size()); }
  [[nodiscard]] int to(int h) const { return at(h).to; }
  [[nodiscard]] int from(int h) const { return at(previous(h)).to; }
  /// Of the half-edge's end, where its beginning is at image 0.
  [[nodiscard]] const Image& image(int h) const { return at(h).image; }
  /// The third corner of the half-edge's triangle, where its beginning is at image 0.
  [[nodiscard]] Corner apex(int h) const;
  [[nodiscard]] int opposite(int h) const { return at(h).opposite; }
  [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] int valence(int v) const { return valences_[static_cast<std::size_t>(v)]; }

  /// A triangle with its first corner at image 0.
  [[nodiscard]] Triangle triangle(int t) const;

  /// Whether no two vertices are neighbors through several images, as in a mesh.
  [[nodiscard]] bool is_simplicial() const;

  /// Replaces an edge by the other diagonal of its two triangles: half-edge h is the new edge then.
  ///
  /// @return  False, with nothing done, if the new edge exists already or would end where it
  ///   begins, or if a vertex would have fewer than three neighbors.
  bool flip(int h);

  /// Takes away a vertex of three neighbors; half-edges and the last vertices are numbered anew.
  void remove(int vertex);

  [[nodiscard]] Eigen::Vector3d edge_vector(int h, const Lattice& lattice) const;
  /// Of the other diagonal of the two triangles at an edge.
  [[nodiscard]] double diagonal_length(int h, const Lattice& lattice) const;

  /// Every edge divided into so many parts, every triangle into as many squared. Points of the net
  /// keep their numbers; with two parts, the midpoints of the edges follow in their order.
  [[nodiscard]] CellNet divided(int parts, const Lattice& lattice) const;
  /// Every triangle divided into three that join its center to those beside it: edges are shorter
  /// by √3 and turned by 30 degrees.
  [[nodiscard]] CellNet divided_by_sqrt3(const Lattice& lattice) const;

 private:
  struct Halfedge {
    int to;
    Image image;
    int opposite;
  };
  [[nodiscard]] const Halfedge& at(int h) const { return halfedges_[static_cast<std::size_t>(h)]; }
  [[nodiscard]] bool has_edge(int from, int to, const Image& image) const;
  /// Finds the opposite of every half-edge.
  void link();
  [[nodiscard]] Eigen::Vector3d position(const Corner& corner, const Lattice& lattice) const;

  std::vector<Halfedge> halfedges_;
  std::vector<int> valences_;
};

}  // namespace trivalent::remesh
