#pragma once

#include <memory>

#include "equalize/constrained_mesh.h"
#include "trivalent/remesh/crystallize.h"

namespace trivalent::remesh {

/// A net that is to be annealed, and the surface it lies on.
struct Net {
  TriMesh mesh;
  ConstrainedMesh on_surface;

  Net(const TriMesh& surface, const Creases& creases) : mesh(surface), on_surface(mesh, creases) {}
  /// Another on the same surface.
  Net(const ConstrainedMesh& other, const ConstrainedMesh::State& state)
      : on_surface(mesh, other, state) {}
};

/// Vertices that a net would have with so many faces, and the topology and boundary that it has.
[[nodiscard]] int vertices_for_faces(const TriMesh& net, double faces);

/// How nets to start from are made.
struct StartingNetOptions {
  double length = 0.0;  ///< of their edges
  Effort effort = Effort::normal;
  double min_vertices = 150.0;  ///< of a coarse net: with fewer there is no room for patches
  std::function<bool()> should_stop = {};
};

/// The surface remeshed by the paper's loop. Its vertices stay on their sheets.
///
/// @return  Null if options.should_stop ended it.
[[nodiscard]] std::unique_ptr<Net> starting_net(const TriMesh& surface, const Creases& creases,
                                                const StartingNetOptions& options);

/// The same at a length several times the final one.
///
/// @param area  Of the surface before its thin parts were inflated.
/// @return      Null if the surface is too small, or too thin in parts, for such a net, or if
///   options.should_stop ended it.
[[nodiscard]] std::unique_ptr<Net> coarse_starting_net(const TriMesh& surface,
                                                       const Creases& creases, double area,
                                                       const StartingNetOptions& options);

/// Number of pairs of faces that cross.
[[nodiscard]] int count_crossings(const TriMesh& mesh);

/// Distance of every vertex of a surface to a net.
[[nodiscard]] std::vector<double> distances_from(const TriMesh& surface, const TriMesh& net);

/// Of the length: how far a vertex of a net of springs may walk on its sheet.
inline constexpr double sheet_reach = 0.1;

/// At most this part of the faces of a net may be flawed.
inline constexpr double max_flawed_fraction = 0.003;

}  // namespace trivalent::remesh
