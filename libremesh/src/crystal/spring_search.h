#pragma once

#include <optional>

#include "crystal/search_watch.h"
#include "crystal/starting_net.h"

namespace trivalent::remesh {

/// A net that a search has found.
struct FoundNet {
  TriMesh mesh;
  bool coarse_start = false;
  int copies = 1;  ///< of the net of a primitive cell
};

/// What a search works on: a surface and the curves that vertices may not leave.
struct SearchSurface {
  const TriMesh& mesh;
  const Creases& creases;
};

/// The ground state of springs on a rigid surface, searched for by annealing: at twice the target
/// length where there is room, then divided and annealed at the target length. For nets that are to
/// lie on the surface, and parts too thin for a net of twice the length.
///
/// @return  Nothing if the search was stopped before there was a net.
[[nodiscard]] std::optional<FoundNet> search_springs(const SearchSurface& surface,
                                                     const CrystalOptions& options,
                                                     SearchWatch& watch);

/// What is wrong with a net, in faces.
struct Flaws {
  int crossings = 0;
  double left_out = 0.0;  ///< faces that would fit the part of the surface that is far from the net
  [[nodiscard]] double sum() const { return crossings + left_out; }
  /// Whether more is covered, and not by faces that cross.
  [[nodiscard]] bool is_better_than(const Flaws& other) const {
    return crossings <= other.crossings && left_out < other.left_out;
  }
};
/// @param m      Length of the edges.
/// @param reach  Farther than this from the net a vertex of the surface is far [mesh's unit].
[[nodiscard]] Flaws find_flaws(const TriMesh& net, const TriMesh& surface, double m, double reach);

}  // namespace trivalent::remesh
