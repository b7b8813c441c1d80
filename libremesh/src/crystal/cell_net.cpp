#include "crystal/cell_net.h"

#include <algorithm>
#include <utility>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

using Image = CellNet::Image;

Image operator+(const Image& a, const Image& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Image operator-(const Image& a, const Image& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Image operator-(const Image& a) { return {-a[0], -a[1], -a[2]}; }

}  // namespace

CellNet::CellNet(std::vector<Eigen::Vector3d> positions_of_vertices,
                 const std::vector<Triangle>& triangles)
    : positions(std::move(positions_of_vertices)) {
  for (const Triangle& corners : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& from = corners[k];
      const Corner& to = corners[(k + 1) % 3];
      halfedges_.push_back({.to = to.vertex, .image = to.image - from.image, .opposite = -1});
    }
  }
  link();
}

CellNet CellNet::of(const TriMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.n_faces());
  for (const auto f : mesh.faces()) {
    const auto h = f.halfedge();
    const VertexHandle a(h.from().idx());
    Triangle corners = {{{a.idx()}, {h.to().idx()}, {h.next().to().idx()}}};
    for (Corner& corner : corners) {
      const VertexHandle v(corner.vertex);
      corner.image = mesh.lattice.image_of(position_beside(mesh, a, v) - mesh.point(v));
    }
    triangles.push_back(corners);
  }
  return {std::vector<Eigen::Vector3d>(mesh.points(), mesh.points() + mesh.n_vertices()),
          triangles};
}

void CellNet::link() {
  // In the order of ends and image, an edge's two half-edges find each other.
  using Key = std::array<int, 5>;
  std::vector<std::pair<Key, int>> by_ends;
  by_ends.reserve(halfedges_.size());
  valences_.assign(positions.size(), 0);
  for (int h = 0; h < n_halfedges(); ++h) {
    const Image& i = image(h);
    by_ends.push_back({{from(h), to(h), i[0], i[1], i[2]}, h});
    ++valences_[index(to(h))];
  }
  std::ranges::sort(by_ends);
  for (int h = 0; h < n_halfedges(); ++h) {
    const Image back = -image(h);
    const Key key = {to(h), from(h), back[0], back[1], back[2]};
    const auto found = std::ranges::lower_bound(by_ends, std::pair(key, 0));
    halfedges_[index(h)].opposite = found->second;
  }
}

CellNet::Corner CellNet::apex(int h) const { return {to(next(h)), image(h) + image(next(h))}; }

CellNet::Triangle CellNet::triangle(int t) const {
  const int h = 3 * t;
  return {{{from(h)}, {to(h), image(h)}, apex(h)}};
}

bool CellNet::is_simplicial() const {
  std::vector<std::pair<int, int>> ends;
  ends.reserve(halfedges_.size());
  for (int h = 0; h < n_halfedges(); ++h) ends.emplace_back(from(h), to(h));
  std::ranges::sort(ends);
  return std::ranges::adjacent_find(ends) == ends.end();
}

bool CellNet::has_edge(int from, int to, const Image& image) const {
  return std::ranges::any_of(halfedges_, [&](const Halfedge& h) {
    return h.to == to && h.image == image && at(h.opposite).to == from;
  });
}

bool CellNet::flip(int h) {
  // Triangles a b c and b a d become d c a and c d b.
  const int g = opposite(h);
  const int a = from(h);
  const int b = to(h);
  const int c = to(next(h));
  const int d = to(next(g));
  const Image from_c_to_d = image(previous(h)) + image(next(g));
  if (c == d || valence(a) <= 3 || valence(b) <= 3 || has_edge(c, d, from_c_to_d)) return false;
  // Where the four half-edges around go.
  const std::array<std::pair<int, int>, 4> moves = {{{previous(h), next(h)},
                                                     {next(g), previous(h)},
                                                     {previous(g), next(g)},
                                                     {next(h), previous(g)}}};
  std::array<Halfedge, 4> moved = {};
  const auto place_of = [&](int old) {
    for (const auto& [source, target] : moves) {
      if (source == old) return target;
    }
    return old;
  };
  for (std::size_t k = 0; k < 4; ++k) {
    moved[k] = at(moves[k].first);
    moved[k].opposite = place_of(moved[k].opposite);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const int target = moves[k].second;
    halfedges_[index(target)] = moved[k];
    halfedges_[index(moved[k].opposite)].opposite = target;
  }
  halfedges_[index(h)] = {.to = c, .image = -from_c_to_d, .opposite = g};
  halfedges_[index(g)] = {.to = d, .image = from_c_to_d, .opposite = h};
  --valences_[index(a)];
  --valences_[index(b)];
  ++valences_[index(c)];
  ++valences_[index(d)];
  return true;
}

void CellNet::remove(int vertex) {
  int out = 0;  // a half-edge from the vertex
  while (from(out) != vertex) ++out;
  // Its three neighbors, one of which is behind the opposite half-edge.
  const int to_third = next(opposite(out));
  std::vector<Triangle> triangles = {
      {{{to(out), image(out)}, apex(out), {to(to_third), image(to_third)}}}};
  for (int t = 0; t < n_halfedges() / 3; ++t) {
    const Triangle corners = triangle(t);
    if (std::ranges::find(corners, vertex, &Corner::vertex) == corners.end()) {
      triangles.push_back(corners);
    }
  }
  // The last vertex takes its number.
  const int last = n_vertices() - 1;
  for (Triangle& corners : triangles) {
    for (Corner& corner : corners) {
      if (corner.vertex == last) corner.vertex = vertex;
    }
  }
  positions[index(vertex)] = positions.back();
  positions.pop_back();
  *this = CellNet(std::move(positions), triangles);
}

Eigen::Vector3d CellNet::position(const Corner& corner, const Lattice& lattice) const {
  return positions[index(corner.vertex)] + lattice.translation(corner.image);
}

Eigen::Vector3d CellNet::edge_vector(int h, const Lattice& lattice) const {
  return position({to(h), image(h)}, lattice) - positions[index(from(h))];
}

double CellNet::diagonal_length(int h, const Lattice& lattice) const {
  const Eigen::Vector3d c = edge_vector(h, lattice) + edge_vector(next(h), lattice);
  return (c - edge_vector(next(opposite(h)), lattice)).norm();
}

CellNet CellNet::divided_by_sqrt3(const Lattice& lattice) const {
  std::vector<Eigen::Vector3d> points = positions;
  for (int t = 0; t < n_halfedges() / 3; ++t) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Corner& corner : triangle(t)) sum += position(corner, lattice);
    points.emplace_back(sum / 3.0);
  }
  // The center of a half-edge's triangle, where the half-edge's beginning is at an image.
  const auto center = [&](int h, Image start) {
    for (int k = h - h % 3; k < h; ++k) start = start - image(k);
    return Corner{n_vertices() + h / 3, start};
  };
  std::vector<Triangle> triangles;
  triangles.reserve(halfedges_.size());
  for (int h = 0; h < n_halfedges(); ++h) {
    triangles.push_back({{{from(h)}, center(opposite(h), image(h)), center(h, {0, 0, 0})}});
  }
  return {std::move(points), triangles};
}

namespace {

/// The points of a divided triangle: i parts towards its second corner, j towards its third.
class TriangleGrid {
 public:
  explicit TriangleGrid(int parts)
      : parts_(parts), points_(index((parts + 1) * (parts + 1)), {-1, {0, 0, 0}}) {}

  [[nodiscard]] CellNet::Corner& at(int i, int j) { return points_[index(i * (parts_ + 1) + j)]; }
  /// The point so many parts along the side from corner k to the next.
  [[nodiscard]] CellNet::Corner& on_side(int k, int part) {
    if (k == 0) return at(part, 0);
    return k == 1 ? at(parts_ - part, part) : at(0, parts_ - part);
  }
  void append_triangles(std::vector<CellNet::Triangle>& triangles) {
    for (int i = 0; i < parts_; ++i) {
      for (int j = 0; i + j < parts_; ++j) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 == parts_) continue;
        triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

 private:
  int parts_;
  std::vector<CellNet::Corner> points_;
};

/// Divides the edges of a net into parts, and its triangles.
class EdgeDivision {
 public:
  EdgeDivision(const CellNet& net, int parts, const Lattice& lattice)
      : net_(net), parts_(parts), lattice_(lattice), points_(net.positions) {}

  [[nodiscard]] CellNet run() {
    divide_edges();
    for (int t = 0; t < net_.n_halfedges() / 3; ++t) divide_triangle(t);
    return {std::move(points_), triangles_};
  }

 private:
  /// The first of two half-edges owns the points between; their images are as its beginning's.
  [[nodiscard]] bool is_owner(int h) const { return h < net_.opposite(h); }

  void divide_edges() {
    first_on_edge_.assign(index(net_.n_halfedges()), -1);
    for (int h = 0; h < net_.n_halfedges(); ++h) {
      if (!is_owner(h)) continue;
      first_on_edge_[index(h)] = static_cast<int>(points_.size());
      const Eigen::Vector3d edge = net_.edge_vector(h, lattice_);
      for (int part = 1; part < parts_; ++part) {
        points_.emplace_back(net_.positions[index(net_.from(h))] + part * edge / parts_);
      }
    }
  }

  void divide_triangle(int t) {
    TriangleGrid grid(parts_);
    for (int k = 0; k < 3; ++k) put_side(t, k, grid);
    const Eigen::Vector3d origin = net_.positions[index(net_.from(3 * t))];
    const Eigen::Vector3d u = net_.edge_vector(3 * t, lattice_) / parts_;
    const Eigen::Vector3d v = -net_.edge_vector(3 * t + 2, lattice_) / parts_;
    for (int i = 1; i < parts_; ++i) {
      for (int j = 1; i + j < parts_; ++j) {
        grid.at(i, j) = {static_cast<int>(points_.size()), {0, 0, 0}};
        points_.emplace_back(origin + i * u + j * v);
      }
    }
    grid.append_triangles(triangles_);
  }

  /// The corner k of a triangle and the points between it and the next.
  void put_side(int t, int k, TriangleGrid& grid) const {
    const CellNet::Triangle corners = net_.triangle(t);
    grid.on_side(k, 0) = corners[index(k)];
    const int h = 3 * t + k;
    const int owner = is_owner(h) ? h : net_.opposite(h);
    const CellNet::Image& start = corners[index(is_owner(h) ? k : (k + 1) % 3)].image;
    for (int part = 1; part < parts_; ++part) {
      const int along_owner = is_owner(h) ? part : parts_ - part;
      grid.on_side(k, part) = {first_on_edge_[index(owner)] + along_owner - 1, start};
    }
  }

  const CellNet& net_;
  int parts_;
  const Lattice& lattice_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> first_on_edge_;
  std::vector<CellNet::Triangle> triangles_;
};

}  // namespace

CellNet CellNet::divided(int parts, const Lattice& lattice) const {
  return EdgeDivision(*this, parts, lattice).run();
}

}  // namespace trivalent::remesh
