#pragma once

#include <functional>

#include "equalize/constrained_mesh.h"

namespace trivalent::remesh {

/// Moves vertices of faces that look into the surface to the middle of their neighbors, until no
/// face does or it is of no use any more.
void unfold(ConstrainedMesh& constrained);

/// Mends a net where it came from one too coarse for thin parts, and leaves the rest of it as it
/// is. In a few rounds, which end early where nothing is left to do: folds are undone; tips that
/// the net is far from get its nearest vertex; edges much longer or shorter than the length are
/// split or collapsed; and after such changes valences are corrected and all vertices relaxed, as
/// by remesh().
///
/// @param surface  The original surface, as it was bound to the net.
void mend_thin_parts(ConstrainedMesh& constrained, const TriMesh& surface, double length);

/// Lifts vertices of crossing faces off the surface, to the sides where their sheets are, little by
/// little until nothing crosses: where a curved part is thinner than chords are deep, those of its
/// two sheets cross though all vertices are on the surface. Vertices on feature curves stay.
void part_sheets(ConstrainedMesh& constrained);

/// Smooths what still crosses: vertices of crossing faces and their neighbors move to the middle of
/// theirs, off the surface, as long as fewer faces cross after it. Mends folds between small parts
/// of a surface, which the normals of the surface do not tell from others. Vertices on feature
/// curves stay.
///
/// @param should_stop  Asked before every step.
void smooth_crossings(ConstrainedMesh& constrained, const std::function<bool()>& should_stop = {});

}  // namespace trivalent::remesh
