#include "equalize/remesh_progress.h"

#include <algorithm>
#include <cmath>

#include "mesh/geometry.h"

namespace trivalent::remesh {

RemeshProgress measure_progress(const TriMesh& mesh) {
  RemeshProgress progress;
  // Counted, since a mesh may hold deleted elements while it is changed.
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const auto e : mesh.edges()) {
    const double length = edge_length(mesh, e);
    count += 1.0;
    sum += length;
    squares += length * length;
  }
  progress.mean_edge_length = sum / count;
  const double variance = squares / count - progress.mean_edge_length * progress.mean_edge_length;
  progress.relative_spread = std::sqrt(std::max(variance, 0.0)) / progress.mean_edge_length;
  int interior = 0;
  int regular = 0;
  for (const auto v : mesh.vertices()) {
    ++progress.vertices;
    if (v.is_boundary()) continue;
    ++interior;
    if (v.valence() == 6) ++regular;
  }
  progress.regular_fraction = interior == 0 ? 0.0 : static_cast<double>(regular) / interior;
  return progress;
}

}  // namespace trivalent::remesh
