#include "equalize/k_ring_laplacian.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// What lies in the plane of normal n, at full length.
Eigen::Vector3d flattened(const Eigen::Vector3d& d, const Eigen::Vector3d& n) {
  const Eigen::Vector3d in_plane = d - n.dot(d) * n;
  const double length = in_plane.norm();
  return length > 0.0 ? Eigen::Vector3d(d.norm() / length * in_plane) : in_plane;
}

struct OneRings {
  IndexLists vertices;
  std::vector<Eigen::Vector3d> edges;  // to vertices.items, flattened into the center's plane
};

OneRings one_rings_of(const TriMesh& mesh, const std::vector<Eigen::Vector3d>& normals) {
  OneRings rings{one_rings(mesh), {}};
  rings.edges.reserve(rings.vertices.items.size());
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) {
    const VertexHandle v(static_cast<int>(i));
    for (const int neighbor : rings.vertices[i]) {
      rings.edges.push_back(flattened(vector_between(mesh, v, VertexHandle(neighbor)), normals[i]));
    }
  }
  return rings;
}

/// 1/S_j; the center itself has no weight.
double weight_of(int hops) { return hops == 0 ? 0.0 : 1.0 / hops; }

struct Hop {
  int vertex = 0;
  int hops = 0;     // S_j
  int parents = 0;  // vertices one hop nearer that it was reached from
  Eigen::Vector3d offset =
      Eigen::Vector3d::Zero();  // from the center, unfolded: mean over the parents

  [[nodiscard]] double weight() const { return weight_of(hops); }
};

/// The smallest rotation that turns the plane of one normal into that of another.
class PlaneRotation {
 public:
  PlaneRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
      : to_(to), sum_(from + to), cosine_(from.dot(to)) {}

  /// d must lie in the first plane.
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& d) const {
    if (cosine_ < -0.99) return d;  // the rotation has no definite axis
    return d - to_.dot(d) / (1.0 + cosine_) * sum_;
  }

 private:
  Eigen::Vector3d to_;
  Eigen::Vector3d sum_;
  double cosine_;
};

/// Walks the rings around a vertex.
class RingWalk {
 public:
  RingWalk(const OneRings& one_rings, const std::vector<Eigen::Vector3d>& normals)
      : one_rings_(one_rings), normals_(normals) {}

  /// All vertices within that many rings, the center included, by index.
  const std::vector<Hop>& around(int center, int rings) {
    found_.assign(1, Hop{center});
    vertices_.assign(1, center);
    std::size_t ring_begin = 0;
    for (int hops = 1; hops <= rings; ++hops) {
      const std::size_t ring_end = found_.size();
      for (std::size_t parent = ring_begin; parent < ring_end; ++parent) reach_from(parent, hops);
      for (std::size_t f = ring_end; f < found_.size(); ++f) found_[f].offset /= found_[f].parents;
      ring_begin = ring_end;
    }
    std::ranges::sort(found_, {}, &Hop::vertex);
    return found_;
  }

 private:
  void reach_from(std::size_t parent, int hops) {
    const auto v = static_cast<std::size_t>(found_[parent].vertex);
    const PlaneRotation rotation(normals_[v], normals_[static_cast<std::size_t>(found_[0].vertex)]);
    const IndexLists& neighbors = one_rings_.vertices;
    for (int at = neighbors.begin[v]; at < neighbors.begin[v + 1]; ++at) {
      const int w = neighbors.items[static_cast<std::size_t>(at)];
      // A handful of vertices: looking through them beats marking all vertices of the mesh.
      const auto known =
          static_cast<std::size_t>(std::ranges::find(vertices_, w) - vertices_.begin());
      if (known == found_.size()) {
        vertices_.push_back(w);
        found_.push_back(Hop{w, hops});
      }
      if (found_[known].hops != hops) continue;
      const Eigen::Vector3d& edge = one_rings_.edges[static_cast<std::size_t>(at)];
      found_[known].offset += found_[parent].offset + rotation(edge);
      ++found_[known].parents;
    }
  }

  const OneRings& one_rings_;
  const std::vector<Eigen::Vector3d>& normals_;
  std::vector<Hop> found_;
  std::vector<int> vertices_;  // of found_, in the order they were reached
};

/// Rows of the matrix for a run of vertices; its values follow from the hops.
struct MatrixRows {
  std::vector<int> sizes;  // entries per row
  std::vector<int> columns;
  std::vector<std::uint8_t> hops;
};

void append_row(const std::vector<Hop>& found, MatrixRows& rows) {
  for (const Hop& hop : found) {
    rows.columns.push_back(hop.vertex);
    rows.hops.push_back(static_cast<std::uint8_t>(hop.hops));
  }
  rows.sizes.push_back(static_cast<int>(found.size()));
}

Eigen::RowVector3d gradient_of(const std::vector<Hop>& found) {
  Eigen::RowVector3d gradient = Eigen::RowVector3d::Zero();
  for (const Hop& hop : found) gradient -= hop.weight() * hop.offset.transpose();
  return gradient;
}

double folding_of(const std::vector<Hop>& found, const std::vector<Eigen::Vector3d>& normals,
                  const Eigen::Vector3d& normal) {
  double turning = 0.0;
  double weights = 0.0;
  for (const Hop& hop : found) {
    turning += hop.weight() * (1.0 - normal.dot(normals[static_cast<std::size_t>(hop.vertex)]));
    weights += hop.weight();
  }
  return weights > 0.0 ? turning / weights : 0.0;
}

/// Strings the runs together.
SparseMatrix assemble(const std::vector<MatrixRows>& runs, Eigen::Index n) {
  SparseMatrix matrix(n, n);
  int* begin = matrix.outerIndexPtr();
  for (const MatrixRows& run : runs) {
    for (const int size : run.sizes) {
      begin[1] = begin[0] + size;
      ++begin;
    }
  }
  matrix.resizeNonZeros(*begin);
  int* column = matrix.innerIndexPtr();
  double* value = matrix.valuePtr();
  for (const MatrixRows& run : runs) {
    column = std::ranges::copy(run.columns, column).out;
    value = std::ranges::transform(run.hops, value, [](int hops) { return -weight_of(hops); }).out;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = 0.0;
    double* diagonal = nullptr;
    for (SparseMatrix::InnerIterator entry(matrix, i); entry; ++entry) {
      sum -= entry.value();
      if (entry.col() == i) diagonal = &entry.valueRef();
    }
    *diagonal = sum;
  }
  return matrix;
}

}  // namespace

KRingSystem k_ring_system(const TriMesh& mesh, const std::vector<Eigen::Vector3d>& normals,
                          int rings) {
  constexpr std::size_t run_length = 4096;
  const OneRings one_rings = one_rings_of(mesh, normals);
  const std::size_t n = mesh.n_vertices();
  std::vector<MatrixRows> runs((n + run_length - 1) / run_length);
  KRingSystem system;
  system.gradient.resize(static_cast<Eigen::Index>(n), 3);
  system.folding.resize(static_cast<Eigen::Index>(n));
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t run) {
    RingWalk walk(one_rings, normals);
    for (std::size_t i = run * run_length; i < std::min(n, (run + 1) * run_length); ++i) {
      const std::vector<Hop>& found = walk.around(static_cast<int>(i), rings);
      append_row(found, runs[run]);
      system.gradient.row(static_cast<Eigen::Index>(i)) = gradient_of(found);
      system.folding[static_cast<Eigen::Index>(i)] = folding_of(found, normals, normals[i]);
    }
  });
  system.laplacian = assemble(runs, static_cast<Eigen::Index>(n));
  return system;
}

}  // namespace trivalent::remesh
