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

/// Fraction of the area where the surface bends like a sphere smaller than this radius [mesh's
/// unit]: its mean curvature, from the angles at the edges around a vertex, exceeds 1/radius.
[[nodiscard]] double tightly_curved_fraction(const TriMesh& mesh, double radius);

/// ∫ (2H)² dA for the mean curvature H as in tightly_curved_fraction(), over the inner vertices:
/// 16π on a sphere of any size. Twice a plate's bending energy is this times its rigidity.
[[nodiscard]] double bending_integral(const TriMesh& mesh);

/// Where a net bends too tightly for its edges.
struct FineParts {
  int vertices = 0;     ///< that bend like a sphere smaller than the radius
  double growth = 1.0;  ///< the shape that many times as large hardly has any; >= 1
};

/// Looks for vertices that bend like a sphere smaller than `radius` [mesh's unit], by mean
/// curvature as tightly_curved_fraction(). "Hardly any" is 1 vertex in 1000. A net sees nothing
/// much finer than its edges: the growth is a lower bound.
[[nodiscard]] FineParts find_fine_parts(const TriMesh& mesh, double radius);

}  // namespace trivalent::remesh
