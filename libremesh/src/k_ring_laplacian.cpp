#include "k_ring_laplacian.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace trivalent::remesh {

namespace {

/// One-rings of all vertices, one after the other.
struct OneRings {
  std::vector<int> begin;
  std::vector<int> vertices;
};

OneRings one_rings_of(const TriMesh& mesh) {
  OneRings rings;
  rings.begin.reserve(mesh.n_vertices() + 1);
  rings.vertices.reserve(2 * mesh.n_edges());
  rings.begin.push_back(0);
  for (const auto v : mesh.vertices()) {
    for (const auto neighbor : v.vertices()) rings.vertices.push_back(neighbor.idx());
    rings.begin.push_back(static_cast<int>(rings.vertices.size()));
  }
  return rings;
}

struct Hop {
  int vertex = 0;
  int hops = 0;     // S_j
  int parents = 0;  // vertices one hop nearer that it was reached from
  Eigen::Vector3d offset =
      Eigen::Vector3d::Zero();  // from the center, unfolded: mean over the parents
};

/// What lies in the plane of normal n, at full length.
Eigen::Vector3d flattened(const Eigen::Vector3d& d, const Eigen::Vector3d& n) {
  const Eigen::Vector3d in_plane = d - n.dot(d) * n;
  const double length = in_plane.norm();
  return length > 0.0 ? Eigen::Vector3d(d.norm() / length * in_plane) : in_plane;
}

/// Turns d, in the plane of normal `from`, into that of normal `to` by the smallest rotation.
Eigen::Vector3d turned(const Eigen::Vector3d& d, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to) {
  const double cosine = from.dot(to);
  if (cosine < -0.99) return d;  // the rotation has no definite axis
  return d - to.dot(d) / (1.0 + cosine) * (from + to);
}

/// Walks the rings around a vertex.
class RingWalk {
 public:
  RingWalk(const Positions& positions, const OneRings& one_rings,
           const std::vector<Eigen::Vector3d>& normals)
      : positions_(positions), one_rings_(one_rings), normals_(normals) {}

  /// All vertices within that many rings, the center included, by index.
  const std::vector<Hop>& around(int center, int rings) {
    found_.assign(1, Hop{center});
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
    const Eigen::Vector3d& normal = normals_[v];
    const Eigen::Vector3d& center_normal = normals_[static_cast<std::size_t>(found_[0].vertex)];
    for (int at = one_rings_.begin[v]; at < one_rings_.begin[v + 1]; ++at) {
      const int w = one_rings_.vertices[static_cast<std::size_t>(at)];
      // A handful of vertices: looking through them beats marking all vertices of the mesh.
      auto known = std::ranges::find(found_, w, &Hop::vertex);
      if (known == found_.end()) known = found_.insert(found_.end(), Hop{w, hops});
      if (known->hops != hops) continue;
      const Eigen::Vector3d edge =
          (positions_.row(w) - positions_.row(found_[parent].vertex)).transpose();
      known->offset +=
          found_[parent].offset + turned(flattened(edge, normal), normal, center_normal);
      ++known->parents;
    }
  }

  const Positions& positions_;
  const OneRings& one_rings_;
  const std::vector<Eigen::Vector3d>& normals_;
  std::vector<Hop> found_;
};

Positions positions_of(const TriMesh& mesh) {
  Positions positions(static_cast<Eigen::Index>(mesh.n_vertices()), 3);
  for (const auto v : mesh.vertices()) positions.row(v.idx()) = mesh.point(v).transpose();
  return positions;
}

}  // namespace

KRingSystem k_ring_system(const TriMesh& mesh, const std::vector<Eigen::Vector3d>& normals,
                          int rings) {
  const OneRings one_rings = one_rings_of(mesh);
  const Positions positions = positions_of(mesh);
  const auto n = static_cast<Eigen::Index>(mesh.n_vertices());
  KRingSystem system{SparseMatrix(n, n), Positions::Zero(n, 3)};
  SparseMatrix& laplacian = system.laplacian;
  int* const row_begin = laplacian.outerIndexPtr();
  const auto for_each_row = [&](const auto& function) {
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, n, 1024), [&](const auto& range) {
      RingWalk walk(positions, one_rings, normals);
      for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
        function(i, walk.around(static_cast<int>(i), rings));
      }
    });
  };
  for_each_row([&](Eigen::Index i, const std::vector<Hop>& found) {
    row_begin[i + 1] = static_cast<int>(found.size());
  });
  for (Eigen::Index i = 0; i < n; ++i) row_begin[i + 1] += row_begin[i];
  laplacian.resizeNonZeros(row_begin[n]);
  for_each_row([&](Eigen::Index i, const std::vector<Hop>& found) {
    double sum = 0.0;
    int diagonal = row_begin[i];
    int at = row_begin[i];
    for (const Hop& hop : found) {
      const double weight = hop.hops == 0 ? 0.0 : 1.0 / hop.hops;
      if (hop.hops == 0) diagonal = at;
      laplacian.innerIndexPtr()[at] = hop.vertex;
      laplacian.valuePtr()[at++] = -weight;
      system.gradient.row(i) -= weight * hop.offset.transpose();
      sum += weight;
    }
    laplacian.valuePtr()[diagonal] = sum;
  });
  return system;
}

}  // namespace trivalent::remesh
