#include "trivalent/remesh/tube_ends.h"

#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "mesh/lattice_path.h"

namespace trivalent::remesh {

namespace {

constexpr const char* property_name = "tube that ends here";

}  // namespace

double circumference_of(ChiralIndices tube) { return length_of({tube.n, tube.m}); }

double LatticePath::distance_to(const ChiralIndices& tube) const {
  double least = std::numeric_limits<double>::infinity();
  constexpr int directions = 6;
  for (int i = 0; i < directions; ++i) {
    least = std::min(least, length_of(sum - turned({tube.n, tube.m}, i)));
  }
  return least;
}

void set_tube_end(TriMesh& surface, VertexHandle v, ChiralIndices tube) {
  auto tubes = OpenMesh::getOrMakeProperty<VertexHandle, ChiralIndices>(surface, property_name);
  tubes[v] = tube;
}

std::optional<ChiralIndices> tube_end(const TriMesh& surface, VertexHandle v) {
  OpenMesh::VPropHandleT<ChiralIndices> tubes;
  if (!surface.get_property_handle(tubes, property_name)) return std::nullopt;
  const ChiralIndices tube = surface.property(tubes, v);
  return tube == ChiralIndices{} ? std::nullopt : std::optional(tube);
}

namespace {

/// What was said of one of the vertices.
std::optional<ChiralIndices> tube_end_of(const TriMesh& surface,
                                         const std::vector<VertexHandle>& loop) {
  for (const VertexHandle v : loop) {
    if (const auto tube = tube_end(surface, v)) return tube;
  }
  return std::nullopt;
}

}  // namespace

std::vector<ChiralIndices> wanted_tube_ends(const TriMesh& surface) {
  std::vector<ChiralIndices> tubes;
  for (const std::vector<VertexHandle>& loop : boundary_loops(surface)) {
    if (const auto tube = tube_end_of(surface, loop)) tubes.push_back(*tube);
  }
  return tubes;
}

std::optional<double> edge_length_of_tubes(const TriMesh& surface) {
  double length = 0.0;
  double edges = 0.0;
  for (const std::vector<VertexHandle>& loop : boundary_loops(surface)) {
    const std::optional<ChiralIndices> tube = tube_end_of(surface, loop);
    if (!tube) continue;
    for (const VertexHandle v : loop) {
      length += std::sqrt(squared_length(surface, surface.halfedge_handle(v)));
    }
    edges += circumference_of(*tube);
  }
  return edges > 0.0 ? std::optional(length / edges) : std::nullopt;
}

std::vector<std::optional<ChiralIndices>> find_tube_ends(const TriMesh& net) {
  std::vector<std::optional<ChiralIndices>> tubes;
  for (const std::vector<VertexHandle>& loop : boundary_loops(net)) {
    LatticePath path;
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    for (const VertexHandle v : loop) {
      path.go(static_cast<int>(net.valence(v)) - 4);
      translation += edge_vector(net, net.halfedge_handle(v));
    }
    tubes.emplace_back();
    // The edge of a ribbon leads to an image of itself, not around a tube.
    const bool is_ribbon = net.lattice.image_of(translation) != Lattice::Image{};
    if (path.deviation != 0 || path.sum.isZero() || is_ribbon) continue;
    while (path.sum.x() <= 0 || path.sum.y() < 0) path.sum = turned(path.sum, 1);
    tubes.back() = {static_cast<int>(path.sum.x()), static_cast<int>(path.sum.y())};
  }
  return tubes;
}

}  // namespace trivalent::remesh
