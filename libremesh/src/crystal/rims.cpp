#include "crystal/rims.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/adjacency.h"

namespace trivalent::remesh {

namespace {

/// Walks along the boundaries of a net in which a patch has been changed.
class RimWalk {
 public:
  RimWalk(const ConstrainedMesh& net, const PatchTopology& patch) : mesh_(net.mesh), patch_(patch) {
    for (int i = 0; i < patch.inner_count(); ++i) {
      if (patch.is_inside(i) && patch.is_open(i)) open_.push_back(i);
    }
  }

  /// One vertex of the patch on each boundary that it touches, and the path from there.
  struct Boundary {
    int start;
    LatticePath path;
  };
  [[nodiscard]] std::vector<Boundary> boundaries() const {
    std::vector<Boundary> all;
    std::vector<int> left = open_;
    while (!left.empty()) {
      const int start = left.front();
      const LatticePath path = walk(start, left);
      all.push_back({start, path});
    }
    return all;
  }

 private:
  /// A vertex inside the patch by number, or else one of the mesh.
  struct Place {
    int number;
    VertexHandle vertex;
  };

  /// @param left  What is met is removed.
  [[nodiscard]] LatticePath walk(int start, std::vector<int>& left) const {
    LatticePath path;
    Place at = {start, VertexHandle()};
    do {
      if (at.number >= 0) {
        std::erase(left, at.number);
        path.go(patch_.deviation(at.number));
      } else {
        path.go(static_cast<int>(mesh_.valence(at.vertex)) - 4);
      }
      at = next(at);
    } while (at.number != start);
    return path;
  }

  /// With the net on the right.
  [[nodiscard]] Place next(const Place& at) const {
    if (at.number >= 0) {
      const int last = patch_.neighbor(at.number, patch_.valence(at.number) - 1);
      return patch_.is_inside(last) ? Place{last, VertexHandle()} : Place{-1, patch_.vertex(last)};
    }
    // A boundary vertex has its boundary halfedge first.
    const VertexHandle v = mesh_.to_vertex_handle(mesh_.halfedge_handle(at.vertex));
    const auto known = std::ranges::find_if(open_, [&](int i) { return patch_.vertex(i) == v; });
    return {known == open_.end() ? -1 : *known, v};
  }

  const TriMesh& mesh_;
  const PatchTopology& patch_;
  std::vector<int> open_;  // vertices of the patch that are on a boundary
};

}  // namespace

int boundary_at(const ConstrainedMesh& net, VertexHandle v) {
  const EdgeHandle e = net.mesh.edge_handle(net.mesh.halfedge_handle(v));
  return net.curves().boundary_of(net.curve_of(e).value()).value();
}

std::vector<Rim> find_rims(const ConstrainedMesh& net) {
  std::vector<Rim> rims(net.curves().boundaries().size());
  for (const std::vector<VertexHandle>& loop : boundary_loops(net.mesh)) {
    const int boundary = boundary_at(net, loop.front());
    Rim& rim = rims[index(boundary)];
    rim.boundary = boundary;
    for (const VertexHandle v : loop) rim.path.go(static_cast<int>(net.mesh.valence(v)) - 4);
  }
  return rims;
}

std::vector<Rim> rims_after(const ConstrainedMesh& net, const PatchTopology& patch) {
  std::vector<Rim> rims;
  for (const auto& [start, path] : RimWalk(net, patch).boundaries()) {
    rims.push_back({boundary_at(net, patch.vertex(start)), path});
  }
  return rims;
}

double rim_energy(const Membrane& membrane, const FeatureCurves& curves, const Rim& rim) {
  const FeatureCurves::Boundary& boundary = curves.boundaries()[index(rim.boundary)];
  const double excess = rim.path.deviation + 3.0 / std::numbers::pi * boundary.turn;
  if (!boundary.tube) return membrane.turn_energy(excess);
  const int coarseness = static_cast<int>(std::lround(membrane.coarseness()));
  const ChiralIndices tube = {boundary.tube->n / coarseness, boundary.tube->m / coarseness};
  return membrane.tube_energy(rim.path.distance_to(tube) + std::abs(excess),
                              rim.path.edges - tube.n - tube.m);
}

double rim_energy(const Membrane& membrane, const ConstrainedMesh& net) {
  double sum = 0.0;
  for (const Rim& rim : find_rims(net)) sum += rim_energy(membrane, net.curves(), rim);
  return sum;
}

bool fits_tubes(const FeatureCurves& curves, int coarseness) {
  return std::ranges::all_of(curves.boundaries(), [&](const FeatureCurves::Boundary& boundary) {
    return !boundary.tube ||
           (boundary.tube->n % coarseness == 0 && boundary.tube->m % coarseness == 0);
  });
}

}  // namespace trivalent::remesh
