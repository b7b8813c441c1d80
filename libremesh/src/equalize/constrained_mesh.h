#pragma once

#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include <array>
#include <memory>
#include <vector>

#include "equalize/feature_curves.h"
#include "mesh/surface_projector.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Where on the original a vertex is, and where it may move.
struct Anchor {
  FeatureKind kind = FeatureKind::none;
  int face = 0;         ///< of the original, at or near the vertex
  CurvePoint on_curve;  ///< for kind `curve`
};

/// A collapse of an edge that respects the features.
struct Collapse {
  HalfedgeHandle halfedge;                             ///< from the removed vertex to the kept one
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the kept vertex afterwards
  Anchor anchor;                                       ///< of the kept vertex afterwards
};

/// A mesh that lies on an original surface: vertices on the surface move on it, those on a feature
/// curve slide along the curve, corners stay. split(), collapse() and flip() keep anchors and
/// curves right.
class ConstrainedMesh {
 public:
  /// @param mesh  The original surface; changed in place by the steps of the remeshing.
  explicit ConstrainedMesh(TriMesh& mesh, const Creases& creases = {});

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
  /// Another net on the same surface.
  ///
  /// @param net    Without elements; becomes that of the state.
  /// @param other  Whose surface it is.
  ConstrainedMesh(TriMesh& net, const ConstrainedMesh& other, const State& state);

  [[nodiscard]] const SurfaceProjector& surface() const { return *surface_; }
  [[nodiscard]] const FeatureCurves& curves() const { return curves_; }

  [[nodiscard]] const Anchor& anchor(VertexHandle v) const { return anchors_[v]; }
  void set_anchor(VertexHandle v, const Anchor& anchor) { anchors_[v] = anchor; }
  /// The feature curve that an edge lies along: such an edge is never flipped, and collapses only
  /// along the curve.
  [[nodiscard]] std::optional<int> curve_of(EdgeHandle e) const { return curve_of_[e]; }
  void set_curve(EdgeHandle e, std::optional<int> curve) { curve_of_[e] = curve; }

  /// From now on vertices stay on their sheet of the surface, even where another one is nearer:
  /// project() walks from the anchor, and no face turns away from its sheet.
  ///
  /// @param reach  If a walk ends farther away than this [mesh's unit], the nearest point is taken
  ///   instead, provided that its normal points the same way.
  void stay_on_sheets(double reach) { reach_ = reach; }
  [[nodiscard]] bool stays_on_sheets() const { return reach_.has_value(); }

  /// The allowed point nearest to p for a vertex with this anchor, which is updated.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& p, Anchor& anchor) const;

  /// Unit normal of the original surface at the vertex.
  [[nodiscard]] Eigen::Vector3d normal(VertexHandle v) const;

  /// Splits an edge at its midpoint, which is then projected unless that turned a face over.
  VertexHandle split(EdgeHandle e);

  /// The collapse that keeps the less free end in place, or meets in the middle; none if it would
  /// move a corner, join two curves, or is topologically impossible.
  [[nodiscard]] std::optional<Collapse> plan_collapse(EdgeHandle e) const;
  /// @param plan  From plan_collapse(), since when the mesh has not changed.
  void collapse(const Collapse& plan);

  /// Flips an edge, unless it is on a boundary or a curve, its flip exists already, or a face would
  /// turn over; whether it was flipped.
  bool flip(EdgeHandle e);

  /// Renumbers vertices, edges and faces along a space-filling curve, so that neighbors lie
  /// together in memory: splits append, and collapses scatter. For large meshes this halves the
  /// time of all steps.
  void renumber();

  /// Divides every face into four at the midpoints of its edges, which go to the surface or, on a
  /// feature curve, to the curve.
  void subdivide();

  TriMesh& mesh;

  /// The mesh must have no deleted vertices.
  [[nodiscard]] State state() const;
  /// Replaces the net.
  void restore(const State& state);

 private:
  [[nodiscard]] bool keeps_curves(HalfedgeHandle h) const;
  /// Curve edges at v and their other ends, but for the one to `except`.
  [[nodiscard]] std::vector<std::pair<VertexHandle, int>> curve_edges_of(VertexHandle v,
                                                                         VertexHandle except) const;
  /// The foot of an edge's midpoint on the side of the surface that the edge is on: in a thin part
  /// the nearest point may be on the other side, so the midpoint is lifted outwards until it is
  /// not.
  [[nodiscard]] Eigen::Vector3d project_between(VertexHandle a, VertexHandle b,
                                                const Eigen::Vector3d& midpoint,
                                                Anchor& anchor) const;
  [[nodiscard]] SurfacePoint foot(const Eigen::Vector3d& p, int face) const;

  std::shared_ptr<const SurfaceProjector> surface_;
  FeatureCurves curves_;
  std::optional<double> reach_;
  OpenMesh::VProp<Anchor> anchors_;
  OpenMesh::EProp<std::optional<int>> curve_of_;
};

}  // namespace trivalent::remesh
