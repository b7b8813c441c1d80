#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trivalent/remesh/mesh.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

/// A place on a feature curve: which curve, which of its segments, and where.
struct CurvePoint {
  int curve = 0;
  int segment = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// What a vertex of the surface is to the features.
enum class FeatureKind {
  none,    ///< inside a smooth region
  curve,   ///< inside a curve: an open boundary or a crease
  corner,  ///< where curves end, meet or turn sharply
};

/// For every edge of a surface whether it is a crease; empty: none is.
using Creases = std::vector<bool>;

/// @param feature_angle  Edges whose faces' normals differ by more than this [rad] are creases;
///   none: no edges.
[[nodiscard]] Creases find_creases(const TriMesh& surface, std::optional<double> feature_angle);

/// The curves of a surface that vertices may slide along but not leave: its open boundaries and its
/// creases, cut at corners.
class FeatureCurves {
 public:
  explicit FeatureCurves(const TriMesh& surface, const Creases& creases = {});

  [[nodiscard]] bool empty() const { return curves_.empty(); }
  [[nodiscard]] int size() const { return static_cast<int>(curves_.size()); }
  [[nodiscard]] double length(int curve) const;

  /// The boundary that a curve is part of, by number; none if it is a crease.
  [[nodiscard]] std::optional<int> boundary_of(int curve) const {
    return boundary_of_[static_cast<std::size_t>(curve)];
  }
  struct Boundary {
    /// How far it turns within the surface [rad], to the side of the surface: 2π around a flat
    /// disc, 0 around the end of a tube, -2π around a hole in a plane.
    double turn = 0.0;
    std::optional<ChiralIndices> tube;  ///< that ends there, if that was said
  };
  [[nodiscard]] const std::vector<Boundary>& boundaries() const { return boundaries_; }

  /// The curve that an edge of the surface is part of.
  [[nodiscard]] std::optional<int> curve_of(EdgeHandle e) const { return curve_of_[index(e)]; }
  [[nodiscard]] FeatureKind kind(VertexHandle v) const { return kinds_[index(v)]; }
  /// Where a vertex of kind `curve` sits.
  [[nodiscard]] const CurvePoint& at(VertexHandle v) const { return places_[index(v)]; }

  /// The point of near's curve that is nearest to p, sought along the curve as far as p has moved;
  /// of its images, in a lattice, that beside p.
  [[nodiscard]] CurvePoint nearest(const Eigen::Vector3d& p, const CurvePoint& near) const;

  /// The same of a whole curve.
  [[nodiscard]] CurvePoint nearest(const Eigen::Vector3d& p, int curve) const;

  /// Unit tangent of the curve there.
  [[nodiscard]] Eigen::Vector3d tangent(const CurvePoint& p) const;

 private:
  struct Curve {
    std::vector<Eigen::Vector3d> points;  // a closed curve repeats its first point at the end
    bool closed = false;
  };

  template <typename Handle>
  static std::size_t index(Handle h) {
    return static_cast<std::size_t>(h.idx());
  }
  void find_corners(const TriMesh& surface);
  void trace_curves(const TriMesh& surface);
  void trace(const TriMesh& surface, HalfedgeHandle first);
  void find_boundaries(const TriMesh& surface);

  Lattice lattice_;
  std::vector<bool> is_feature_;
  std::vector<std::optional<int>> curve_of_;
  std::vector<FeatureKind> kinds_;
  std::vector<CurvePoint> places_;
  std::vector<Curve> curves_;
  std::vector<std::optional<int>> boundary_of_;  // of each curve
  std::vector<Boundary> boundaries_;
};

}  // namespace trivalent::remesh
