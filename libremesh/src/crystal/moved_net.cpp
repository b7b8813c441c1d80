#include "crystal/moved_net.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"

namespace trivalent::remesh {

namespace {

Eigen::Vector3d position_of(const ConeNet::Mean& mean, const TriMesh& net) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += mean.weights[k] * net.point(VertexHandle(mean.vertices[k]));
  }
  return sum;
}

/// By how much a side is longer on the surface than in the net.
double growth_of(const ConeNet& cones, int h, const TriMesh& net, const SurfaceProjector& surface) {
  const int parts = std::max(1, static_cast<int>(std::lround(length_of(cones.side(h)))));
  Eigen::Vector3d last = position_of(cones.mean_on_side(h, 0, parts), net);
  Eigen::Vector3d last_foot = surface.nearest(last).position;
  double length = 0.0;
  double length_of_feet = 0.0;
  for (int part = 1; part <= parts; ++part) {
    const Eigen::Vector3d p = position_of(cones.mean_on_side(h, part, parts), net);
    const Eigen::Vector3d foot = surface.nearest(p).position;
    length += (p - last).norm();
    length_of_feet += (foot - last_foot).norm();
    last = p;
    last_foot = foot;
  }
  return length_of_feet / length;
}

bool is_mesh(const ConstrainedMesh::State& state) {
  try {
    static_cast<void>(make_mesh(state.positions, state.triangles));
  } catch (const InvalidMesh&) {
    return false;
  }
  return true;
}

/// With vertices where the net has them, or between.
///
/// @param given  Of the net.
/// @param moved  The same, with other sides.
/// @return       Nothing if two vertices would be neighbors twice.
std::optional<ConstrainedMesh::State> moved_net(const TriMesh& net, const ConeNet& given,
                                                const ConeNet& moved,
                                                const SurfaceProjector& surface) {
  ConeNet::Net found = moved.net();
  ConstrainedMesh::State state;
  for (const ConeNet::Place& place : found.places) {
    state.positions.push_back(position_of(given.mean_at(moved, place), net));
    state.anchors.emplace_back().face = surface.nearest(state.positions.back()).face;
  }
  state.triangles = std::move(found.triangles);
  return is_mesh(state) ? std::optional(std::move(state)) : std::nullopt;
}

}  // namespace

bool are_alike(const TriMesh& a, const TriMesh& b) {
  const auto is_one_and_closed = [](const TriMesh& mesh) {
    return !has_boundary(mesh) && !mesh.lattice.is_periodic() &&
           find_components(mesh).parts.size() == 1;
  };
  return is_one_and_closed(a) && is_one_and_closed(b) &&
         euler_characteristic(a) == euler_characteristic(b);
}

std::optional<ConstrainedMesh::State> carried_net(const TriMesh& net,
                                                  const SurfaceProjector& surface,
                                                  WantedSides wanted) {
  const ConeNet given(triangles_of(net), net.n_vertices());
  wanted.lengths.resize(index(given.n_halfedges()));
  for (int h = 0; h < given.n_halfedges(); ++h) {
    const int g = given.opposite(h);
    wanted.lengths[index(h)] = g < h ? wanted.lengths[index(g)]
                                     : length_of(given.side(h)) * growth_of(given, h, net, surface);
  }
  ConeNet cones = given;
  fit_sides(cones, wanted);
  return moved_net(net, given, cones, surface);
}

void divide_in_space(ConstrainedMesh& net) {
  TriMesh& mesh = net.mesh;
  std::vector<Eigen::Vector3d> positions(mesh.points(), mesh.points() + mesh.n_vertices());
  positions.reserve(mesh.n_vertices() + mesh.n_edges());
  for (const auto e : mesh.edges()) {
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
    positions.push_back(midpoint(mesh, mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)));
  }
  net.subdivide();
  for (const auto v : mesh.vertices()) mesh.point(v) = positions[index(v)];
}

std::optional<ConstrainedMesh::State> divided_net(const TriMesh& net,
                                                  const SurfaceProjector& surface, int parts,
                                                  const WantedSides& wanted) {
  const ConeNet given(triangles_of(net), net.n_vertices());
  ConeNet cones = given.enlarged(parts);
  fit_sides(cones, wanted);
  return moved_net(net, given, cones, surface);
}

}  // namespace trivalent::remesh
