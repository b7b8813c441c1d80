#pragma once

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Sharp edges of a surface, in the mesh's unit.
struct FeatureLines {
  int edges = 0;
  double length = 0.0;
};

/// Edges whose faces' normals differ by more than `angle` [rad].
[[nodiscard]] FeatureLines find_feature_lines(const TriMesh& mesh, double angle);

/// Fraction of the area whose mean curvature exceeds that of a sphere of this radius [mesh's unit],
/// 1/radius. Curvatures come from the dihedral angles around each vertex.
[[nodiscard]] double tightly_curved_fraction(const TriMesh& mesh, double radius);

/// ∫ (2H)² dA for the mean curvature H as in tightly_curved_fraction(), over the inner vertices:
/// 16π on a sphere of any size. Twice a plate's bending energy is this times its rigidity.
[[nodiscard]] double bending_integral(const TriMesh& mesh);

/// ∫ H dA for the mean curvature H, > 0 where the surface is convex: 4πR on a sphere. The surface
/// at a distance d has the area A + 2d ∫ H dA + d² ∫ K dA [Steiner1840].
[[nodiscard]] double mean_curvature_integral(const TriMesh& mesh);

/// ∫ K dA for the Gaussian curvature K: 2π times the Euler characteristic of a surface without
/// boundary [Bonnet1848], else the angles that are missing around the inner vertices.
[[nodiscard]] double gauss_curvature_integral(const TriMesh& mesh);

/// Parts of a net that bend too tightly for its edges.
struct FineParts {
  int vertices = 0;     ///< with a mean curvature above 1/radius
  double growth = 1.0;  ///< factor by which to enlarge the shape to get rid of them; >= 1
};

/// Finds vertices with a mean curvature above 1/radius [mesh's unit], as tightly_curved_fraction()
/// does. `growth` leaves 1 such vertex in 1000. It is a lower bound, since a net does not resolve
/// what is much finer than its edges.
[[nodiscard]] FineParts find_fine_parts(const TriMesh& mesh, double radius);

}  // namespace trivalent::remesh
