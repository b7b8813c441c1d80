#pragma once

#include <optional>
#include <span>
#include <vector>

#include "crystal/lbfgs.h"
#include "crystal/membrane.h"
#include "crystal/vertex_images.h"
#include "equalize/constrained_mesh.h"
#include "mesh/point_grid.h"

namespace trivalent::remesh {

/// What holds a vertex: planes through a foot on the surface; two across a feature curve, three at
/// a corner.
struct VertexHold {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 3> normals;
  std::array<double, 3> stiffness{};  ///< of each plane [eV/Å²]
  int count = 0;
};

/// A net as a membrane in space, held to its surface.
///
/// Lengths are in Å, at the scale where the target length is Membrane::fine_length.
class MembraneNet {
 public:
  /// A point of the surface and the part of a vertex's area it stands for.
  struct Sample {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
    double weight;
  };

  /// @param constrained  The net; its vertices leave the surface, their anchors stay on it.
  /// @param surface      As it was bound to the net.
  MembraneNet(ConstrainedMesh& constrained, const TriMesh& surface, const Membrane& membrane);

  [[nodiscard]] ConstrainedMesh& constrained() { return constrained_; }
  [[nodiscard]] const ConstrainedMesh& constrained() const { return constrained_; }
  [[nodiscard]] const Membrane& membrane() const { return membrane_; }
  void set_membrane(const Membrane& membrane) { membrane_ = membrane; }

  /// Removes deleted vertices, and finds feet and pulls anew.
  void renew();
  /// What holds a vertex since the last renew(), or since set_hold().
  [[nodiscard]] const VertexHold& hold(VertexHandle v) const { return holds_[index(v)]; }
  void set_hold(VertexHandle v, const VertexHold& hold);
  /// Puts a new vertex onto the curve of the boundary that it is on.
  void set_anchor_on_boundary(VertexHandle v, Anchor anchor);
  /// Numbers of samples that pull at a vertex.
  [[nodiscard]] std::span<const int> pulls(VertexHandle v) const;
  [[nodiscard]] const Sample& sample(int i) const { return samples_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] VertexHold hold_at(const Eigen::Vector3d& position, Anchor& anchor,
                                   bool is_boundary) const;

  /// Moves all vertices towards the minimum of the energy.
  ///
  /// @param should_stop  Asked before every step; once it returns true, the rest are left out.
  void relax(int steps, const std::function<bool()>& should_stop = {});
  /// The same with steps that reach across the whole net, for one that is far from its minimum.
  void relax_across(int steps, const std::function<bool()>& should_stop = {});

  /// Lengths of all edges at rest [Å], in place of the membrane's; until connectivity changes.
  void set_rest_lengths(std::vector<double> lengths) { rest_lengths_ = std::move(lengths); }

  /// Energy per vertex without cores and count [eV].
  [[nodiscard]] double elastic_energy();
  /// Energy of all cores [eV].
  [[nodiscard]] double core_energy() const;

 private:
  void find_pulls();
  [[nodiscard]] std::optional<VertexHandle> owner_of(const Sample& sample,
                                                     const PointGrid& grid) const;
  [[nodiscard]] MembraneTerms<double> terms(VertexImages& images) const;
  void add_contacts(MembraneTerms<double>& terms, VertexImages& images) const;
  void minimize(int steps, bool across_net, const std::function<bool()>& should_stop);

  ConstrainedMesh& constrained_;
  Membrane membrane_;
  std::vector<double> rest_lengths_;
  std::vector<Sample> samples_;
  std::vector<VertexHold> holds_;
  std::vector<int> pull_begin_;  // of each vertex in `pulled_`, and the end of the last
  std::vector<int> pulled_;
  Lbfgs<double> minimizer_;
};

/// Pairs of vertices may touch that are nearer than this [contact distances] at the start: what
/// they may move until pairs are found anew.
inline constexpr double contact_skin = 1.6;

}  // namespace trivalent::remesh
