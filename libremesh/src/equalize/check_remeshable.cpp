#include "equalize/check_remeshable.h"

#include <algorithm>
#include <cmath>

#include "mesh/geometry.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"

namespace trivalent::remesh {

namespace {

void check_options(const TriMesh& mesh, const RemeshOptions& options) {
  if (mesh.n_faces() == 0) throw InvalidMesh("remesh: the mesh has no faces");
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) {
      throw InvalidMesh(concat("remesh: vertex ", v.idx(), " belongs to no face; remove it"));
    }
  }
  const double m = options.target_edge_length;
  if (!(m > 0.0) || !std::isfinite(m)) {
    throw InvalidOption(
        concat("remesh: target edge length is ", m, "; it must be a positive number"));
  }
  if (options.iterations < 1 || options.iterations > 1000) {
    throw InvalidOption(
        concat("remesh: ", options.iterations, " iterations; 1 to 1000 are possible"));
  }
  if (options.rings < 1 || options.rings > 8) {
    throw InvalidOption(concat("remesh: ", options.rings, " rings; 1 to 8 are possible"));
  }
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0)) {
    throw InvalidOption(
        concat("remesh: tolerance σ/m is ", options.tolerance, "; it must lie between 0 and 1"));
  }
  if (options.feature_angle && !(*options.feature_angle > 0.0)) {
    throw InvalidOption(
        concat("remesh: feature angle is ", *options.feature_angle, " rad; it must be positive"));
  }
}

void check_lattice(const TriMesh& mesh, double target) {
  if (!mesh.lattice.is_periodic()) return;
  const double largest = longest_edge_in(mesh.lattice);
  if (target <= largest) return;
  throw InvalidOption(concat("remesh: a target edge length of ", target,
                             " is too large for a lattice whose shortest translation is ",
                             mesh.lattice.shortest(), "; use at most ", largest,
                             ", or a supercell"));
}

void check_that_target_fits(const TriMesh& mesh, double target) {
  double area = 0.0;
  const MeshComponents components = find_components(mesh);
  for (std::size_t i = 0; i < components.parts.size(); ++i) {
    const MeshComponent& component = components.parts[i];
    area += component.area;
    if (!(component.area > 0.0) || !std::isfinite(component.area)) {
      throw InvalidMesh(concat("remesh: a part of the mesh has the area ", component.area,
                               "; remove flat parts, or scale the mesh to ordinary numbers"));
    }
    const double largest = longest_edge_for(component.area, component.is_closed());
    if (target > largest) {
      throw InvalidOption(concat("remesh: a target edge length of ", target, " is too large for ",
                                 component.is_closed() ? "a closed" : "an open", " part of area ",
                                 component.area, "; it can hold at most ", largest));
    }
    if (mesh.lattice.is_periodic()) continue;  // a tube, or a net of tubes, need not be closed
    const double length = component.box.longest_side();
    const double largest_along = longest_edge_along(component.area, length, component.is_closed());
    if (target > largest_along) {
      const auto first_face = std::ranges::find(components.of_face, static_cast<int>(i));
      throw InvalidOption(
          concat("remesh: the part with face ", first_face - components.of_face.begin(), " is ",
                 length, " long and too narrow for edges of ", target,
                 "; remove vertices that lie far off, or use edges of at most ", largest_along));
    }
  }
  const double smallest = std::sqrt(area / max_faces / unit_triangle_area);
  if (target < smallest) {
    throw InvalidOption(concat("remesh: a target edge length of ", target, " on an area of ", area,
                               " makes more than ", max_faces, " faces; use at least ", smallest));
  }
}

}  // namespace

void check_remeshable(const TriMesh& mesh, const RemeshOptions& options) {
  check_options(mesh, options);
  check_lattice(mesh, options.target_edge_length);
  check_that_target_fits(mesh, options.target_edge_length);
}

}  // namespace trivalent::remesh
