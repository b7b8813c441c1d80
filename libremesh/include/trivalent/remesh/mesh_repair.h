#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/remesh/mesh_diagnosis.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// How far repair() may go.
enum class RepairMethod {
  none,  ///< no change: throw if make_mesh() would
  safe,  ///< connect, orient and clean the faces; the shape stays
  wrap,  ///< build a new closed surface around everything, a small offset outside it
};

enum class HolePolicy { keep, fill };
enum class ComponentPolicy { keep_all, keep_largest };

struct RepairOptions {
  RepairMethod method = RepairMethod::safe;
  HolePolicy holes = HolePolicy::keep;                     ///< for RepairMethod::safe
  ComponentPolicy components = ComponentPolicy::keep_all;  ///< the largest by area
  /// Size of the holes and gaps that a wrap closes and of the detail it loses, in the mesh's unit,
  /// > 0. If empty, 1/100 of the bounding box's diagonal, and for points at least 3 times their
  /// spacing.
  std::optional<double> wrap_alpha = std::nullopt;
  /// Distance from the input to the wrap, in the mesh's unit, > 0. If empty, 1/30 of alpha, or one
  /// edge of the planned net where the wrap would be thinner.
  std::optional<double> wrap_offset = std::nullopt;
  /// Edge length of the planned net on a surface, in its unit. A wrap of an open surface has two
  /// sides, and nets on sides closer than their edges cross each other. If empty, thickness is not
  /// checked.
  std::function<double(const TriMesh&)> edge_length_on = {};
};

/// A repaired surface, and what was changed.
struct RepairResult {
  TriMesh mesh;
  std::vector<std::string> notes;  ///< those of the soup, and one sentence per kind of change
  double offset = 0.0;             ///< of a wrap, in the mesh's unit; 0 otherwise
};

/// Turns triangles into an oriented 2-manifold.
///
/// RepairMethod::safe, in this order: sets coordinates below 1e-60 of the size to zero; joins
/// coincident points where edges lack a second face; drops repeated faces; turns faces so that
/// neighbors agree; separates surfaces that meet in an edge of more than two faces (faces that
/// enclose a wedge of the inside stay together) or in a vertex; turns closed components that
/// are inside out; drops isolated points; removes flat faces by flips and collapses.
/// RepairMethod::wrap is CGAL's alpha wrapping [Portaneri2022]; it also takes points without any
/// faces. For edge_length_on, its thickness is the mean one: 2V/A of its volume and area.
///
/// @throws InvalidMesh   if no sound surface results; the message says what to try.
/// @throws InvalidOption if a wrap length is out of its range.
///
/// Cost: O(n log n) for n faces, a wrap O((size/alpha)²) or more.
[[nodiscard]] RepairResult repair(const TriangleSoup& soup, const RepairOptions& options = {});
/// The same, for a soup whose diagnosis is known.
[[nodiscard]] RepairResult repair(const TriangleSoup& soup, const RepairOptions& options,
                                  const MeshDiagnosis& diagnosis);

}  // namespace trivalent::remesh
