#include "trivalent/remesh/periodic.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "mesh/edge_table.h"
#include "mesh/geometry.h"
#include "mesh/point_grid.h"
#include "mesh/self_intersections.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"

namespace trivalent::remesh {

namespace {

/// Halves edges until all are well below half of the shortest translation. Boundaries that are
/// images of each other are halved at the same places.
void halve_long_edges(TriMesh& mesh, double longest) {
  for (bool changes = true; changes;) {
    changes = false;
    const std::size_t n = mesh.n_edges();
    for (std::size_t i = 0; i < n; ++i) {
      const EdgeHandle e(static_cast<int>(i));
      if (edge_length(mesh, e) <= longest) continue;
      const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
      mesh.split(e, midpoint(mesh, mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)));
      changes = true;
    }
  }
}

double shortest_boundary_edge(const TriMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto e : mesh.edges()) {
    if (e.is_boundary()) shortest = std::min(shortest, edge_length(mesh, e));
  }
  return shortest;
}

/// Refuses what no cell is meant for, before long edges are halved without end.
void check_size(const TriMesh& mesh, const Lattice& lattice) {
  if (!lattice.is_periodic()) {
    throw InvalidOption("joined_in_cell: nothing is periodic in this cell");
  }
  constexpr double max_cells = 1000.0;  // from the origin to a vertex
  for (const auto v : mesh.vertices()) {
    const double distance = mesh.point(v).norm();
    if (distance <= max_cells * lattice.shortest()) continue;
    throw InvalidMesh(concat("joined_in_cell: vertex ", v.idx(), " is ", distance,
                             " from the origin, more than ", max_cells,
                             " cells; give the cell in the mesh's unit, or move the mesh"));
  }
}

/// A translation that is not zero, but for rounding.
bool leads_elsewhere(const Lattice& lattice, const Eigen::Vector3d& translation) {
  return lattice.image_of(translation) != Lattice::Image{0, 0, 0};
}

/// Distance from a boundary vertex to the nearest image of another one.
double distance_to_images(const TriMesh& mesh, VertexHandle v) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto w : mesh.vertices()) {
    if (w == v || !w.is_boundary()) continue;
    const Eigen::Vector3d apart = mesh.point(w) - mesh.point(v);
    const Eigen::Vector3d separation = mesh.lattice.nearest(apart);
    if (leads_elsewhere(mesh.lattice, separation - apart)) {
      nearest = std::min(nearest, separation.norm());
    }
  }
  return nearest;
}

[[noreturn]] void throw_no_partner(const TriMesh& mesh, VertexHandle v) {
  const Eigen::Vector3d& p = mesh.point(v);
  const double distance = distance_to_images(mesh, v);
  const std::string nearest =
      std::isfinite(distance) ? concat("the nearest image of another one is ", distance, " away")
                              : "no image of another one is near";
  throw InvalidMesh(concat("joined_in_cell: the boundary vertex at (", p.x(), ", ", p.y(), ", ",
                           p.z(), ") has no partner: ", nearest,
                           "; give the cell that the mesh fits, or, if it has an edge there, make "
                           "fewer directions periodic"));
}

/// Finds the vertices at the ends of a mesh that is about one cell long: those that have no
/// neighbor beyond.
class CellEnds {
 public:
  CellEnds(const TriMesh& mesh, double tolerance)
      : inverse_(periodic_part(mesh.lattice).completeOrthogonalDecomposition().pseudoInverse()),
        low_(Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())),
        high_(-low_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      margin_[row] = 2.0 * tolerance * inverse_.row(row).norm();
    }
    for (const auto v : mesh.vertices()) {
      const Eigen::Vector3d place = inverse_ * mesh.point(v);
      low_ = low_.cwiseMin(place);
      high_ = high_.cwiseMax(place);
    }
  }

  [[nodiscard]] bool has(const Eigen::Vector3d& p) const {
    const Eigen::Array3d place = inverse_ * p;
    const Eigen::Array3d extent = high_ - low_;
    const auto is_long = (extent - 1.0).abs() <= margin_;
    const auto is_at_end = place - low_.array() <= margin_ || high_.array() - place <= margin_;
    return (is_long && is_at_end).any();
  }

 private:
  static Eigen::Matrix3d periodic_part(const Lattice& lattice) {
    Eigen::Matrix3d vectors = lattice.cell();
    for (std::size_t k = 0; k < 3; ++k) {
      if (!lattice.periodic()[k]) vectors.col(static_cast<Eigen::Index>(k)).setZero();
    }
    return vectors;
  }

  Eigen::Matrix3d inverse_;  // from places to cell vectors
  Eigen::Vector3d low_;
  Eigen::Vector3d high_;
  Eigen::Array3d margin_ = Eigen::Array3d::Zero();
};

/// Boundary vertices that are images of each other.
struct Partners {
  DisjointSets sets;
  Lattice::Periodic is_joined = {};        ///< along each cell vector
  std::vector<VertexHandle> without = {};  ///< boundary vertices that have none
};

Partners find_partners(const TriMesh& mesh, double tolerance) {
  Partners partners = {.sets = DisjointSets(mesh.n_vertices())};
  const PointGrid grid(mesh, 4.0 * tolerance, tolerance);
  for (const auto v : mesh.vertices()) {
    if (!v.is_boundary()) continue;
    bool has_partner = false;
    grid.visit(mesh.point(v), tolerance, [&](int other, const Eigen::Vector3d& separation) {
      const VertexHandle w(other);
      // Vertices at one place are not joined: that would close the mesh onto itself.
      const Eigen::Vector3d translation = mesh.point(v) + separation - mesh.point(w);
      if (!mesh.is_boundary(w) || !leads_elsewhere(mesh.lattice, translation)) return;
      has_partner = true;
      partners.sets.join(index(v), index(w));
      const Lattice::Image image = mesh.lattice.image_of(translation);
      for (std::size_t k = 0; k < 3; ++k) {
        partners.is_joined[k] = partners.is_joined[k] || image[k] != 0;
      }
    });
    if (!has_partner) partners.without.push_back(v);
  }
  return partners;
}

/// Refuses vertices without partner that cannot be on an open edge.
void check_edges(const TriMesh& mesh, const Partners& partners, double tolerance) {
  if (partners.without.empty()) return;
  const Lattice::Periodic& periodic = mesh.lattice.periodic();
  const bool may_have_edges = periodic != Lattice::Periodic{true, true, true};
  const CellEnds ends(mesh, tolerance);
  for (const VertexHandle v : partners.without) {
    if (!may_have_edges || ends.has(mesh.point(v))) throw_no_partner(mesh, v);
  }
  if (partners.is_joined != periodic) throw_no_partner(mesh, partners.without.front());
}

/// For every vertex the one that stands for it and its images.
std::vector<VertexHandle> representatives(const TriMesh& mesh, double tolerance) {
  Partners partners = find_partners(mesh, tolerance);
  check_edges(mesh, partners, tolerance);
  std::vector<VertexHandle> kept;
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) {
    kept.emplace_back(static_cast<int>(partners.sets.find(i)));
  }
  return kept;
}

TriMesh surface_of(const std::vector<Eigen::Vector3d>& points,
                   const std::vector<std::array<int, 3>>& triangles) {
  try {
    return make_mesh(points, triangles);
  } catch (const InvalidMesh& error) {
    throw InvalidMesh(concat("joined_in_cell: the joined faces are no surface (", error.what(),
                             "); the ends of the mesh must match along their whole length, in the "
                             "cell that it fits"));
  }
}

}  // namespace

TriMesh joined_in_cell(TriMesh mesh, const Lattice& lattice) {
  constexpr double part_of_edge = 1e-2;
  check_size(mesh, lattice);
  halve_long_edges(mesh, 0.9 * longest_edge_in(lattice));
  const double shortest = shortest_boundary_edge(mesh);
  mesh.lattice = lattice;
  std::vector<VertexHandle> kept;
  if (std::isfinite(shortest)) {
    kept = representatives(mesh, part_of_edge * shortest);
  } else {
    for (const auto v : mesh.vertices()) kept.push_back(v);
  }
  std::vector<int> numbers(mesh.n_vertices(), -1);
  std::vector<Eigen::Vector3d> points;
  for (const auto v : mesh.vertices()) {
    if (kept[index(v)] != v) continue;
    numbers[index(v)] = static_cast<int>(points.size());
    points.push_back(mesh.point(v));
  }
  std::vector<std::array<int, 3>> triangles;
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.fv_range(f)) corners[k++] = numbers[index(kept[index(v)])];
    triangles.push_back(corners);
  }
  TriMesh joined = surface_of(points, triangles);
  const std::size_t before = find_crossing_faces(joined).count;
  joined.lattice = lattice;
  const CrossingFaces crossing = find_crossing_faces(joined, 1);
  if (crossing.count > before) {
    const Eigen::Vector3d p = face_centroid(joined, FaceHandle(crossing.first.front()[0]));
    throw InvalidMesh(concat("joined_in_cell: the surface meets its own image in ",
                             crossing.count - before, " pairs of triangles, first at (", p.x(),
                             ", ", p.y(), ", ", p.z(), "); give a larger cell"));
  }
  return joined;
}

namespace {

/// The cells of a lattice that one cell of a coarser lattice holds.
class CellsOfSupercell {
 public:
  /// @param multiples  Vectors of the coarser lattice as sums of those of the finer one, as
  /// columns.
  explicit CellsOfSupercell(const Eigen::Matrix3i& multiples)
      : multiples_(multiples), inverse_(multiples.cast<double>().inverse()) {
    const Eigen::Vector3i low = multiples.cwiseMin(0).rowwise().sum();
    const Eigen::Vector3i high = multiples.cwiseMax(0).rowwise().sum();
    for (int c = low[2]; c < std::max(high[2], 1); ++c) {
      for (int b = low[1]; b < std::max(high[1], 1); ++b) {
        for (int a = low[0]; a < std::max(high[0], 1); ++a) {
          const Lattice::Image cell = {a, b, c};
          if (inside(cell) != cell) continue;
          numbers_.emplace(cell, static_cast<int>(cells_.size()));
          cells_.push_back(cell);
        }
      }
    }
  }

  [[nodiscard]] const std::vector<Lattice::Image>& cells() const { return cells_; }

  /// Number of the cell of which another one is an image.
  [[nodiscard]] int number(const Lattice::Image& cell) const { return numbers_.at(inside(cell)); }

 private:
  /// The image of a cell that lies in the supercell.
  [[nodiscard]] Lattice::Image inside(const Lattice::Image& cell) const {
    constexpr double margin = 1e-6;  // of rounding
    const Eigen::Vector3i place(cell[0], cell[1], cell[2]);
    const Eigen::Vector3d parts = inverse_ * place.cast<double>();
    const Eigen::Vector3i counts = (parts.array() + margin).floor().cast<int>();
    const Eigen::Vector3i rest = place - multiples_ * counts;
    return {rest[0], rest[1], rest[2]};
  }

  Eigen::Matrix3i multiples_;
  Eigen::Matrix3d inverse_;
  std::vector<Lattice::Image> cells_;
  std::map<Lattice::Image, int> numbers_;
};

TriMesh copied(const TriMesh& mesh, const CellsOfSupercell& supercell) {
  const int n = static_cast<int>(mesh.n_vertices());
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const Lattice::Image& cell : supercell.cells()) {
    const Eigen::Vector3d shift = mesh.lattice.translation(cell);
    for (const auto v : mesh.vertices()) points.push_back(mesh.point(v) + shift);
    for (const auto f : mesh.faces()) {
      const auto corners = corners_of(mesh, f);
      std::array<int, 3> copies{};
      std::size_t k = 0;
      for (const auto v : mesh.fv_range(f)) {
        const Lattice::Image to = mesh.lattice.image_of(corners[k] - mesh.point(v));
        copies[k++] =
            v.idx() + n * supercell.number({cell[0] + to[0], cell[1] + to[1], cell[2] + to[2]});
      }
      triangles.push_back(copies);
    }
  }
  return make_mesh(points, triangles);
}

void check_size(const TriMesh& mesh, double times, std::string_view caller) {
  const double faces = times * static_cast<double>(mesh.n_faces());
  if (faces > max_faces) {
    throw InvalidOption(
        concat(caller, ": the supercell would have ", faces, " faces, more than ", max_faces));
  }
}

}  // namespace

TriMesh repeated(const TriMesh& mesh, const std::array<int, 3>& times) {
  Lattice::Cell cell = mesh.lattice.cell();
  double copies = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (times[k] < 1 || (times[k] > 1 && !mesh.lattice.periodic()[k])) {
      throw InvalidOption(concat("repeated: ", times[k], " times along cell vector ", k + 1,
                                 "; it must be 1 or more, and 1 where nothing is periodic"));
    }
    cell.col(static_cast<Eigen::Index>(k)) *= times[k];
    copies *= times[k];
  }
  check_size(mesh, copies, "repeated");
  if (times == std::array{1, 1, 1}) return mesh;
  const Eigen::Vector3i multiples(times[0], times[1], times[2]);
  TriMesh supercell = copied(mesh, CellsOfSupercell(multiples.asDiagonal()));
  supercell.lattice = Lattice(cell, mesh.lattice.periodic());
  return supercell;
}

TriMesh in_supercell(const TriMesh& mesh, const Lattice& cell) {
  constexpr double tolerance = 1e-6;
  if (mesh.lattice.periodic() != Lattice::Periodic{true, true, true} ||
      cell.periodic() != mesh.lattice.periodic()) {
    throw InvalidOption("in_supercell: three directions must be periodic");
  }
  const Eigen::Matrix3d multiples = mesh.lattice.cell().inverse() * cell.cell();
  const Eigen::Matrix3d whole = multiples.array().round();
  if ((multiples - whole).cwiseAbs().maxCoeff() > tolerance) {
    throw InvalidOption("in_supercell: the cell vectors are no whole multiples of the mesh's");
  }
  check_size(mesh, whole.determinant(), "in_supercell");
  TriMesh supercell = copied(mesh, CellsOfSupercell(whole.cast<int>()));
  supercell.lattice = cell;
  return supercell;
}

}  // namespace trivalent::remesh
