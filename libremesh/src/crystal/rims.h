#pragma once

#include <vector>

#include "crystal/membrane.h"
#include "crystal/patch_topology.h"
#include "equalize/constrained_mesh.h"
#include "mesh/lattice_path.h"

namespace trivalent::remesh {

/// A boundary of a net.
struct Rim {
  int boundary = 0;  ///< of the surface's feature curves, by number
  LatticePath path;
};

/// The boundary of the surface that a boundary vertex of a net is on, by number.
[[nodiscard]] int boundary_at(const ConstrainedMesh& net, VertexHandle v);

/// All boundaries of a net, by number.
[[nodiscard]] std::vector<Rim> find_rims(const ConstrainedMesh& net);

/// The boundaries that a patch touches, as they will be with the patch.
[[nodiscard]] std::vector<Rim> rims_after(const ConstrainedMesh& net, const PatchTopology& patch);

/// Energy of how a boundary turns and of the tube that it is the end of [eV].
///
/// A boundary that turns as the surface's does leaves the net inside with the pentagons and
/// heptagons that the surface's curvature asks for (Gauss and Bonnet), and none that a step of the
/// boundary stands against.
[[nodiscard]] double rim_energy(const Membrane& membrane, const FeatureCurves& curves,
                                const Rim& rim);
/// Of all boundaries.
[[nodiscard]] double rim_energy(const Membrane& membrane, const ConstrainedMesh& net);

/// Whether a net of this coarseness can be divided into one that ends in the wanted tubes.
[[nodiscard]] bool fits_tubes(const FeatureCurves& curves, int coarseness);

}  // namespace trivalent::remesh
