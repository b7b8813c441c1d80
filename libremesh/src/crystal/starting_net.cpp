#include "crystal/starting_net.h"

#include <algorithm>
#include <cmath>

#include "crystal/spring_relaxation.h"
#include "crystal/thin_parts.h"
#include "equalize/paper_loop.h"
#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::remesh {

namespace {

/// Iterations of the paper's loop that make the net to start from.
constexpr int first_iterations = 20;
constexpr int quick_first_iterations = 14;  // after 8, folds of some coarse nets are left
constexpr int first_sweeps = 60;            // of the springs

RemeshOptions paper_options(const StartingNetOptions& options) {
  return {.target_edge_length = options.length,
          .iterations = options.effort == Effort::quick ? quick_first_iterations : first_iterations,
          .should_stop = options.should_stop};
}

/// Whether the net of this edge length sees the shape, but for a few thin parts that can be mended
/// after the division: all but a few faces look about where the surface does at their corners and
/// cross none, and no part of the surface is left out.
bool is_sound(const Net& net, const TriMesh& surface, double length) {
  constexpr double min_cosine = 0.25;
  constexpr double farthest_covered = 1.6;  // edges: tips may be cut off, but no fingers
  int astray = count_crossings(net.mesh);
  for (const auto f : net.mesh.faces()) {
    const Eigen::Vector3d normal = face_normal(net.mesh, f);
    Eigen::Vector3d there = Eigen::Vector3d::Zero();
    for (const auto v : f.vertices()) there += net.on_surface.normal(v);
    if (normal.dot(there) < min_cosine * there.norm()) ++astray;
  }
  if (astray > max_flawed_fraction * static_cast<double>(net.mesh.n_faces())) return false;
  return std::ranges::max(distances_from(surface, net.mesh)) < farthest_covered * length;
}

/// Whether every part of the surface has room for edges of this length.
bool can_hold(const TriMesh& surface, double length) {
  if (surface.lattice.is_periodic()) return length <= longest_edge_in(surface.lattice);
  return std::ranges::all_of(find_components(surface).parts, [&](const MeshComponent& part) {
    return length <= longest_edge_for(part.area, part.is_closed()) &&
           length <= longest_edge_along(part.area, part.box.longest_side(), part.is_closed());
  });
}

}  // namespace

int count_crossings(const TriMesh& mesh) { return measure_quality(mesh).self_intersections; }

std::vector<double> distances_from(const TriMesh& surface, const TriMesh& net) {
  const std::vector<Eigen::Vector3d> points(surface.points(),
                                            surface.points() + surface.n_vertices());
  return distances_to_surface(points, net);
}

int vertices_for_faces(const TriMesh& net, double faces) {
  // E = (3F + B)/2 for B boundary edges, so that V = χ + F/2 + B/2.
  const auto boundary =
      std::ranges::count_if(net.edges(), [](const auto e) { return e.is_boundary(); });
  return euler_characteristic(net) +
         static_cast<int>(std::lround(0.5 * (faces + static_cast<double>(boundary))));
}

std::unique_ptr<Net> starting_net(const TriMesh& surface, const Creases& creases,
                                  const StartingNetOptions& options) {
  auto net = std::make_unique<Net>(surface, creases);
  if (!remesh_in_place(net->on_surface, paper_options(options), [](const RemeshProgress&) {}))
    return nullptr;
  net->on_surface.stay_on_sheets(sheet_reach * options.length);
  return net;
}

std::unique_ptr<Net> coarse_starting_net(const TriMesh& surface, const Creases& creases,
                                         double area, const StartingNetOptions& options) {
  const double unit_area = 2.0 * unit_triangle_area;  // per vertex of a net of edge 1
  const double length = options.length;
  if (area < options.min_vertices * unit_area * length * length) return nullptr;
  if (!can_hold(surface, length)) return nullptr;
  std::unique_ptr<Net> net = starting_net(surface, creases, options);
  if (!net) return nullptr;
  unfold(net->on_surface);
  relax_springs(net->on_surface, length, first_sweeps);
  return is_sound(*net, surface, length) ? std::move(net) : nullptr;
}

}  // namespace trivalent::remesh
