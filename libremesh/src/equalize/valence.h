#pragma once

#include <vector>

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// By how much every vertex's valence differs from what it should be: 6, or 4 on a boundary, where
/// half of the ring is missing. Taken once per sweep over the edges: counting around a vertex anew
/// for every edge costs more than all the rest of the sweep.
[[nodiscard]] std::vector<int> valence_deviations(const TriMesh& mesh);

[[nodiscard]] inline int squared(int deviation) { return deviation * deviation; }

/// The four vertices around an edge, named as in [Pecanha2013, Figure 1]: the edge runs from v1 to
/// v3, v2 and v4 are opposite to it. The edge must not be on a boundary.
struct EdgeNeighborhood {
  VertexHandle v1, v2, v3, v4;
};
[[nodiscard]] EdgeNeighborhood neighborhood_of(const TriMesh& mesh, EdgeHandle e);

/// Flips every edge whose flip brings the valences of its four vertices closer to what they should
/// be [Pecanha2013, Algorithm 4], and the edge's length down where the valences are as good either
/// way.
///
/// Three things are not in the paper. A flip that would turn a face over, make a sliver, double an
/// edge or leave a feature curve is not done: without this the surface folds. Deviations are summed
/// squared, so that one vertex of valence 4 counts more than two of 5. And ties fall to the shorter
/// edge, which lets 5-7 pairs glide to where they cancel; without these two, 1 to 2 % fewer
/// vertices end up regular.
///
/// @return Number of flips.
int correct_valences(ConstrainedMesh& constrained);

}  // namespace trivalent::remesh
