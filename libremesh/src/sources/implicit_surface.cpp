#include "sources/implicit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// Point of the grid: all coordinates even (corners of cubes) or all odd (their centers).
using Site = std::array<int, 3>;

Site operator+(const Site& a, const Site& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

constexpr std::array<Site, 8> to_other_kind = {{{-1, -1, -1},
                                                {1, -1, -1},
                                                {-1, 1, -1},
                                                {1, 1, -1},
                                                {-1, -1, 1},
                                                {1, -1, 1},
                                                {-1, 1, 1},
                                                {1, 1, 1}}};
constexpr std::array<Site, 6> to_same_kind = {
    {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}}};

/// Fractions of an edge within which a cut moves its end onto the surface, [Labelle2007, table 1].
constexpr double snap_along_long = 0.24999;
constexpr double snap_along_short = 0.41189;

/// Mean edge of the result in units of the grid, measured on the double torus after relaxation.
constexpr double edge_per_unit = 1.54;

constexpr int relaxation_sweeps = 5;
constexpr int newton_steps = 4;

/// Where the sites of a grid lie.
struct Grid {
  Eigen::Vector3d origin;   ///< of the site (0, 0, 0)
  Eigen::Matrix3d steps;    ///< from a site to the next numbers, as columns
  Site period = {0, 0, 0};  ///< numbers after which sites repeat; 0 where they do not
  Site size = {0, 0, 0};    ///< numbers to march over, of a cell

  [[nodiscard]] double unit() const { return steps.colwise().norm().maxCoeff(); }
};

Grid grid_around(const BoundingBox& box, double unit) {
  return {.origin = box.low, .steps = unit * Eigen::Matrix3d::Identity()};
}

Grid grid_in(const Lattice& lattice, double unit) {
  // Fewer cubes, and a site would be on both sides of another.
  constexpr double min_cubes = 3.0;
  Grid grid{.origin = Eigen::Vector3d::Zero(), .steps = lattice.cell()};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const Eigen::Vector3d along = lattice.cell().col(i);
    const double cubes = std::max(std::round(0.5 * along.norm() / unit), min_cubes);
    grid.size[k] = 2 * static_cast<int>(cubes);
    grid.steps.col(i) /= grid.size[k];
    if (lattice.periodic()[k]) {
      grid.period[k] = grid.size[k];
    } else {
      grid.origin -= 0.5 * along;
    }
  }
  return grid;
}

class Polygonizer {
 public:
  Polygonizer(const ImplicitSurface& surface, const Grid& grid)
      : surface_(surface), grid_(grid), unit_(grid.unit()) {}

  TriMesh run() {
    if (grid_.size != Site{0, 0, 0}) {
      list_all_cubes();
    } else {
      const double longest = surface_.box.longest_side() / unit_;
      int side = 2;
      while (side < longest) side *= 2;
      find_cubes({0, 0, 0}, side);
    }
    for (const Site& cube : cubes_) march_cube(cube);
    if (triangles_.empty()) {
      throw InvalidMesh("polygonize: the function has one sign everywhere; there is no surface");
    }
    TriMesh mesh = make_mesh(points_, triangles_);
    if (surface_.lattice.is_periodic()) mesh.lattice = surface_.lattice;
    return mesh;
  }

 private:
  struct Node {
    double value = 0.0;
    Eigen::Vector3d position;
    int vertex = -1;  ///< of the mesh, once the node lies on the surface and is used
  };

  static std::uint64_t key_of(const Site& s) {
    // 21 bits each, from -2^20; the face limit of make_shape keeps coordinates far below that.
    const auto bits = [](int x) { return static_cast<std::uint64_t>(std::int64_t{x} + (1 << 20)); };
    return bits(s[0]) << 42 | bits(s[1]) << 21 | bits(s[2]);
  }

  Eigen::Vector3d position_of(const Site& s) const {
    return grid_.origin + grid_.steps * Eigen::Vector3d(s[0], s[1], s[2]);
  }

  /// The same site by the numbers of the cell.
  Site in_cell(Site site) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const int period = grid_.period[k];
      if (period > 0) site[k] = (site[k] % period + period) % period;
    }
    return site;
  }

  void list_all_cubes() {
    for (int a = 0; a < grid_.size[0]; a += 2) {
      for (int b = 0; b < grid_.size[1]; b += 2) {
        for (int c = 0; c < grid_.size[2]; c += 2) cubes_.push_back({a, b, c});
      }
    }
  }

  /// Collects the cubes near the surface, by octants; `side` counts lattice units, cubes have two.
  void find_cubes(const Site& low, int side) {
    const double half = 0.5 * side;
    const Eigen::Vector3d center = position_of(low) + Eigen::Vector3d::Constant(half * unit_);
    // The tetrahedra of a cube reach one unit beyond its upper faces.
    const double reach = std::sqrt(3.0) * (half + 1.0) * unit_;
    if (std::abs(surface_.value(center)) > reach) return;
    if (side == 2) {
      cubes_.push_back(low);
      return;
    }
    const int step = side / 2;
    for (const Site& corner : to_other_kind) {
      find_cubes(
          low + Site{corner[0] > 0 ? step : 0, corner[1] > 0 ? step : 0, corner[2] > 0 ? step : 0},
          step);
    }
  }

  double value_at(const Site& site) {
    const auto [found, is_new] = value_by_site_.try_emplace(key_of(site), 0.0);
    if (is_new) found->second = surface_.value(position_of(site));
    return found->second;
  }

  /// Where the edge from a site of value `from` to a neighbor is cut, as a fraction; none if not.
  std::optional<double> cut_towards(double from, const Site& neighbor) {
    const double to = value_at(neighbor);
    if ((from < 0.0) == (to < 0.0)) return std::nullopt;
    return from / (from - to);
  }

  Node make_node(const Site& site) {
    Node node{value_at(site), position_of(site), -1};
    const Eigen::Vector3d start = node.position;
    const double value = node.value;
    if (!surface_.snaps || std::abs(value) > 2.0 * unit_) return node;
    double nearest = 3.0;  // in units, longer than every edge
    const auto try_neighbor = [&](const Site& offset, double length, double snap) {
      const auto cut = cut_towards(value, site + offset);
      if (!cut || *cut > snap || *cut * length >= nearest) return;
      nearest = *cut * length;
      node.position =
          start + *cut * (grid_.steps * Eigen::Vector3d(offset[0], offset[1], offset[2]));
      node.value = 0.0;
    };
    for (const Site& offset : to_other_kind) try_neighbor(offset, std::sqrt(3.0), snap_along_short);
    for (const Site& offset : to_same_kind) try_neighbor(offset, 2.0, snap_along_long);
    return node;
  }

  int node_at(const Site& any_image) {
    const Site site = in_cell(any_image);
    const auto [found, is_new] =
        node_by_site_.try_emplace(key_of(site), static_cast<int>(nodes_.size()));
    if (is_new) nodes_.push_back(make_node(site));
    return found->second;
  }

  int add_point(const Eigen::Vector3d& p) {
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  /// Mesh vertex between an inside node and one that is not: the node itself if it was snapped.
  int vertex_between(int inside, int other) {
    Node& end = nodes_[static_cast<std::size_t>(other)];
    if (end.value == 0.0) {
      if (end.vertex < 0) end.vertex = add_point(end.position);
      return end.vertex;
    }
    const auto key = static_cast<std::uint64_t>(inside) << 32 | static_cast<std::uint32_t>(other);
    const auto [found, is_new] = vertex_on_edge_.try_emplace(key, 0);
    if (is_new) {
      const Node& start = nodes_[static_cast<std::size_t>(inside)];
      const double t = start.value / (start.value - end.value);
      const Eigen::Vector3d edge = surface_.lattice.nearest(end.position - start.position);
      found->second = add_point(start.position + t * edge);
    }
    return found->second;
  }

  void add_triangle(int a, int b, int c) {
    if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
  }

  /// The four tetrahedra around each of the three lattice edges from the cube's center upwards.
  void march_cube(const Site& low) {
    const Site center = low + Site{1, 1, 1};
    const int from = node_at(center);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Site along{};
      Site right{};
      Site up{};
      along[axis] = 2;
      right[(axis + 1) % 3] = 2;
      up[(axis + 2) % 3] = 2;
      const int to = node_at(center + along);
      const Site corner = low + along;
      const std::array<int, 4> around = {node_at(corner), node_at(corner + right),
                                         node_at(corner + right + up), node_at(corner + up)};
      for (std::size_t k = 0; k < 4; ++k)
        march_tetrahedron({from, around[k], around[(k + 1) % 4], to});
    }
  }

  /// All tetrahedra come with one orientation: the last corner sees the first three
  /// counter-clockwise.
  void march_tetrahedron(std::array<int, 4> corner) {
    std::array<std::size_t, 4> inside{};
    std::array<std::size_t, 4> outside{};
    std::size_t n_inside = 0;
    std::size_t n_outside = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (nodes_[static_cast<std::size_t>(corner[k])].value < 0.0)
        inside[n_inside++] = k;
      else
        outside[n_outside++] = k;
    }
    const auto cut = [&](std::size_t in, std::size_t out) {
      return vertex_between(corner[in], corner[out]);
    };
    if (n_inside == 1) {
      const auto [a, b, c] = opposite_face[inside[0]];
      add_triangle(cut(inside[0], a), cut(inside[0], b), cut(inside[0], c));
    } else if (n_inside == 3) {
      const auto [a, b, c] = opposite_face[outside[0]];
      add_triangle(cut(a, outside[0]), cut(c, outside[0]), cut(b, outside[0]));
    } else if (n_inside == 2) {
      auto [p, q] = std::array{inside[0], inside[1]};
      // (p, q, r, s) with the orientation of (0, 1, 2, 3).
      const bool even =
          (p == 0 && q == 1) || (p == 0 && q == 3) || (p == 1 && q == 2) || (p == 2 && q == 3);
      if (!even) std::swap(p, q);
      const std::size_t r = outside[0];
      const std::size_t s = outside[1];
      add_quad({cut(p, r), cut(p, s), cut(q, s), cut(q, r)});
    }
  }

  void add_quad(const std::array<int, 4>& v) {
    const auto squared = [&](std::size_t a, std::size_t b) {
      return surface_.lattice
          .nearest(points_[static_cast<std::size_t>(v[a])] -
                   points_[static_cast<std::size_t>(v[b])])
          .squaredNorm();
    };
    if (squared(0, 2) <= squared(1, 3)) {
      add_triangle(v[0], v[1], v[2]);
      add_triangle(v[0], v[2], v[3]);
    } else {
      add_triangle(v[0], v[1], v[3]);
      add_triangle(v[1], v[2], v[3]);
    }
  }

  /// Corners of the face across corner k, counter-clockwise as seen from outside.
  static constexpr std::array<std::array<std::size_t, 3>, 4> opposite_face = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

  const ImplicitSurface& surface_;
  Grid grid_;
  double unit_;
  std::vector<Site> cubes_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, double> value_by_site_;
  std::unordered_map<std::uint64_t, int> node_by_site_;
  std::unordered_map<std::uint64_t, int> vertex_on_edge_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
};

Eigen::Vector3d gradient(const ImplicitSurface& surface, const Eigen::Vector3d& p, double step) {
  Eigen::Vector3d g;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
    g[k] = (surface.value(p + d) - surface.value(p - d)) / (2.0 * step);
  }
  return g;
}

Eigen::Vector3d onto_surface(const ImplicitSurface& surface, Eigen::Vector3d p, double step) {
  // Where two sheets meet, distances have next to no gradient, and a step would lead anywhere.
  constexpr double min_squared_slope = 0.1;
  const double close_enough = 1e-3 * step;
  for (int i = 0; i < newton_steps; ++i) {
    const double value = surface.value(p);
    if (std::abs(value) < close_enough) break;
    const Eigen::Vector3d g = gradient(surface, p, step);
    p -= value / std::max(g.squaredNorm(), min_squared_slope) * g;
  }
  return p;
}

/// Moves every vertex to the centroid of its one-ring and back onto the surface.
void even_out(TriMesh& mesh, const ImplicitSurface& surface, double edge_length) {
  const double step = 1e-4 * edge_length;
  std::vector<Eigen::Vector3d> moved(mesh.n_vertices());
  for (int sweep = 0; sweep < relaxation_sweeps; ++sweep) {
    for (const auto v : mesh.vertices()) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int valence = 0;
      for (const auto w : mesh.vv_range(v)) {
        sum += position_beside(mesh, v, w);
        ++valence;
      }
      moved[static_cast<std::size_t>(v.idx())] = onto_surface(surface, sum / valence, step);
    }
    for (const auto v : mesh.vertices()) mesh.point(v) = moved[static_cast<std::size_t>(v.idx())];
  }
}

}  // namespace

TriMesh polygonize(const ImplicitSurface& surface, double edge_length) {
  const double unit = edge_length / edge_per_unit;
  const Grid grid = surface.lattice.cell().isZero(0.0) ? grid_around(surface.box, unit)
                                                       : grid_in(surface.lattice, unit);
  TriMesh mesh = Polygonizer(surface, grid).run();
  if (std::ranges::any_of(mesh.edges(), [](const auto e) { return e.is_boundary(); })) {
    throw InvalidMesh("polygonize: the surface leaves the box; make the box larger");
  }
  even_out(mesh, surface, edge_length);
  return mesh;
}

TriMesh polygonize_any(ImplicitSurface surface, double edge_length) {
  try {
    return polygonize(surface, edge_length);
  } catch (const InvalidMesh&) {
    surface.snaps = false;
    try {
      return polygonize(surface, edge_length);
    } catch (const InvalidMesh&) {
    }
    throw;  // what was wrong in the first place
  }
}

}  // namespace trivalent::remesh
