#pragma once

#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include <array>
#include <vector>

#include "equalize/feature_curves.h"
#include "mesh/surface_projector.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Where a vertex may go and where on the original it sits.
struct Anchor {
  FeatureKind kind = FeatureKind::none;
  int face = 0;         ///< of the original, at or near the vertex
  CurvePoint on_curve;  ///< for kind `curve`
};

/// A mesh that lies on an original surface: vertices on the surface move on it, those on a feature
/// curve slide along the curve, corners stay.
class ConstrainedMesh {
 public:
  /// @param mesh  The original surface; changed in place by the steps of the remeshing.
  explicit ConstrainedMesh(TriMesh& mesh, const Creases& creases = {});

  [[nodiscard]] const SurfaceProjector& surface() const { return surface_; }
  [[nodiscard]] const FeatureCurves& curves() const { return curves_; }

  [[nodiscard]] const Anchor& anchor(VertexHandle v) const { return anchors_[v]; }
  void set_anchor(VertexHandle v, const Anchor& anchor) { anchors_[v] = anchor; }
  /// The feature curve that an edge lies along: such an edge is never flipped, and collapses only
  /// along the curve.
  [[nodiscard]] std::optional<int> curve_of(EdgeHandle e) const { return curve_of_[e]; }
  void set_curve(EdgeHandle e, std::optional<int> curve) { curve_of_[e] = curve; }

  /// From now on vertices stay on the sheet of the surface that they are on, though in a thin part
  /// another may be nearer: project() walks from the anchor, and no face turns away from its sheet.
  ///
  /// @param reach  A walk that ends farther away [mesh's unit] has run into a valley: the nearest
  /// point, if it looks the same way, is then taken instead.
  void stay_on_sheets(double reach) { reach_ = reach; }
  [[nodiscard]] bool stays_on_sheets() const { return reach_.has_value(); }

  /// The allowed point nearest to p for a vertex with this anchor, which is updated.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& p, Anchor& anchor) const;

  /// Unit normal of the original surface at the vertex.
  [[nodiscard]] Eigen::Vector3d normal(VertexHandle v) const;

  /// Numbers vertices, edges and faces anew along a space-filling curve, so that neighbors lie
  /// together in memory: splits append, and collapses scatter. For large meshes this halves the
  /// time of all steps.
  void renumber();

  /// Divides every face into four at the midpoints of its edges, which go to the surface or, on a
  /// feature curve, to the curve.
  void subdivide();

  TriMesh& mesh;

  struct CurveEdge {
    VertexHandle from, to;
    int curve;
  };
  /// A net and its place on the surface, numbered from 0 without gaps.
  struct State {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Anchor> anchors;
    std::vector<std::array<int, 3>> triangles;
    std::vector<CurveEdge> curve_edges;
  };
  /// The mesh must have no deleted vertices.
  [[nodiscard]] State state() const;
  /// Replaces the net.
  void restore(const State& state);

 private:
  /// The foot of an edge's midpoint on the side of the surface that the edge is on: in a thin part
  /// the nearest point may be on the other side, so the midpoint is lifted outwards until it is
  /// not.
  [[nodiscard]] Eigen::Vector3d project_between(VertexHandle a, VertexHandle b,
                                                const Eigen::Vector3d& midpoint,
                                                Anchor& anchor) const;
  [[nodiscard]] SurfacePoint foot(const Eigen::Vector3d& p, int face) const;

  SurfaceProjector surface_;
  FeatureCurves curves_;
  std::optional<double> reach_;
  OpenMesh::VProp<Anchor> anchors_;
  OpenMesh::EProp<std::optional<int>> curve_of_;
};

}  // namespace trivalent::remesh
