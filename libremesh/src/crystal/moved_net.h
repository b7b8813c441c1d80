#pragma once

#include <optional>

#include "crystal/side_fit.h"
#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Whether two surfaces are closed, of one component and of as many handles; not periodic.
[[nodiscard]] bool are_alike(const TriMesh& a, const TriMesh& b);

/// The net of a closed surface carried over to another one beside it, larger or smaller: its
/// disclinations stay above each other as nearly as the lattice allows, and between them there are
/// as many more vertices as there is more room.
///
/// @param net      At rest beside the surface.
/// @param surface  Of a mesh that is like the net, as of are_alike().
/// @param wanted   Without lengths, which follow from the surface.
/// @return  With vertices where the net is; nothing if two would be neighbors twice.
[[nodiscard]] std::optional<ConstrainedMesh::State> carried_net(const TriMesh& net,
                                                                const SurfaceProjector& surface,
                                                                WantedSides wanted);

/// Divides every face into four at the midpoints of its edges, which stay off the surface.
void divide_in_space(ConstrainedMesh& net);

/// A net with every edge divided, and the disclinations where they want to be, to about an edge of
/// the divided net.
///
/// @param net      Closed.
/// @param surface  Near the net.
/// @param parts    Of every edge.
/// @param wanted   Of the divided net, with sides as those of the cone net of `net`.
/// @return  As carried_net().
[[nodiscard]] std::optional<ConstrainedMesh::State> divided_net(const TriMesh& net,
                                                                const SurfaceProjector& surface,
                                                                int parts,
                                                                const WantedSides& wanted);

}  // namespace trivalent::remesh
