#include "trivalent/remesh/periodic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "mesh/geometry.h"
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

/// Sets of boundary vertices that are images of each other.
class Partners {
 public:
  Partners(const TriMesh& mesh, const Lattice& lattice, double tolerance)
      : mesh_(mesh), lattice_(lattice), tolerance_(tolerance) {
    for (const auto v : mesh.vertices()) {
      if (v.is_boundary()) boundary_.push_back(v);
    }
    // Sorted along x of the cell, so that partners are near in this order or at its ends.
    kept_.resize(mesh.n_vertices());
    for (const auto v : mesh.vertices()) kept_[index(v)] = v;
    join();
  }

  /// The vertex that stands for v and its images.
  [[nodiscard]] VertexHandle kept(VertexHandle v) const { return kept_[index(v)]; }

 private:
  void join() {
    for (std::size_t i = 0; i < boundary_.size(); ++i) {
      const VertexHandle v = boundary_[i];
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < boundary_.size(); ++j) {
        if (i == j) continue;
        const Eigen::Vector3d apart = mesh_.point(boundary_[j]) - mesh_.point(v);
        const double distance = lattice_.nearest(apart).norm();
        // Two vertices of one place are not joined: that would close the mesh onto itself.
        const bool is_image = (lattice_.nearest(apart) - apart).norm() > tolerance_;
        if (!is_image) continue;
        nearest = std::min(nearest, distance);
        if (distance > tolerance_) continue;
        kept_[index(v)] = std::min(kept_[index(v)], boundary_[j]);
      }
      if (nearest <= tolerance_) continue;
      const Eigen::Vector3d& p = mesh_.point(v);
      throw InvalidMesh(concat("joined_in_cell: the boundary vertex at (", p.x(), ", ", p.y(), ", ",
                               p.z(), ") has no partner: the nearest image of another one is ",
                               nearest, " away; give the cell that the mesh fits"));
    }
    // Corners of the cell have several partners.
    for (const VertexHandle v : boundary_) {
      while (kept_[index(v)] != kept_[index(kept_[index(v)])]) {
        kept_[index(v)] = kept_[index(kept_[index(v)])];
      }
    }
  }

  const TriMesh& mesh_;
  const Lattice& lattice_;
  double tolerance_;
  std::vector<VertexHandle> boundary_;
  std::vector<VertexHandle> kept_;
};

}  // namespace

TriMesh joined_in_cell(TriMesh mesh, const Lattice& lattice) {
  constexpr double part_of_edge = 1e-2;
  halve_long_edges(mesh, 0.9 * longest_edge_in(lattice));
  const Partners partners(mesh, lattice, part_of_edge * shortest_boundary_edge(mesh));
  std::vector<int> numbers(mesh.n_vertices(), -1);
  std::vector<Eigen::Vector3d> points;
  for (const auto v : mesh.vertices()) {
    if (partners.kept(v) != v) continue;
    numbers[index(v)] = static_cast<int>(points.size());
    points.push_back(mesh.point(v));
  }
  std::vector<std::array<int, 3>> triangles;
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.fv_range(f)) corners[k++] = numbers[index(partners.kept(v))];
    triangles.push_back(corners);
  }
  TriMesh joined = make_mesh(points, triangles);
  joined.lattice = lattice;
  return joined;
}

TriMesh repeated(const TriMesh& mesh, const std::array<int, 3>& times) {
  Lattice::Cell cell = mesh.lattice.cell();
  double faces = static_cast<double>(mesh.n_faces());
  for (std::size_t k = 0; k < 3; ++k) {
    if (times[k] < 1 || (times[k] > 1 && !mesh.lattice.periodic()[k])) {
      throw InvalidOption(concat("repeated: ", times[k], " times along cell vector ", k + 1,
                                 "; it must be 1 or more, and 1 where nothing is periodic"));
    }
    cell.col(static_cast<Eigen::Index>(k)) *= times[k];
    faces *= times[k];
  }
  if (faces > max_faces) {
    throw InvalidOption(
        concat("repeated: the supercell would have ", faces, " faces, more than ", max_faces));
  }
  if (times == std::array{1, 1, 1}) return mesh;
  const int n = static_cast<int>(mesh.n_vertices());
  const auto copy_of = [&](int v, const Lattice::Image& image) {
    std::array<int, 3> place{};
    for (std::size_t k = 0; k < 3; ++k) place[k] = (image[k] % times[k] + times[k]) % times[k];
    return v + n * (place[0] + times[0] * (place[1] + times[1] * place[2]));
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (int c = 0; c < times[2]; ++c) {
    for (int b = 0; b < times[1]; ++b) {
      for (int a = 0; a < times[0]; ++a) {
        const Eigen::Vector3d shift = mesh.lattice.translation({a, b, c});
        for (const auto v : mesh.vertices()) points.push_back(mesh.point(v) + shift);
        for (const auto f : mesh.faces()) {
          const auto corners = corners_of(mesh, f);
          std::array<int, 3> copies{};
          std::size_t k = 0;
          for (const auto v : mesh.fv_range(f)) {
            const Lattice::Image to = mesh.lattice.image_of(corners[k] - mesh.point(v));
            copies[k++] = copy_of(v.idx(), {a + to[0], b + to[1], c + to[2]});
          }
          triangles.push_back(copies);
        }
      }
    }
  }
  TriMesh supercell = make_mesh(points, triangles);
  supercell.lattice = Lattice(cell, mesh.lattice.periodic());
  return supercell;
}

}  // namespace trivalent::remesh
