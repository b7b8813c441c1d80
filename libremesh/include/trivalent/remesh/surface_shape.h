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

}  // namespace trivalent::remesh
