#pragma once

#include <array>
#include <optional>
#include <vector>

#include "crystal/membrane_net.h"
#include "crystal/patch_topology.h"

namespace trivalent::remesh {

/// A piece cut out of a membrane net, whose connectivity can be changed and whose vertices move in
/// space, while two rings around it stay fixed. The energy of a move is measured here without
/// touching the mesh.
class MembranePatch {
 public:
  /// Vertices up to four edges from the center move. Hinges reach two rings farther.
  static constexpr PatchReach reach = {.inner = 4, .known = 5};

  /// @param grid   All vertices of the net, to find those of other sheets.
  /// @param marks  Numbers of the patch's vertices stay there until the next patch.
  MembranePatch(const MembraneNet& net, VertexHandle center, const PointGrid& grid,
                PatchMarks& marks);

  [[nodiscard]] bool is_whole() const { return topology_.is_whole(); }
  [[nodiscard]] const PatchTopology& topology() const { return topology_; }
  [[nodiscard]] Eigen::Vector3d position(int i) const {
    return origin_ + x_[at(i)].cast<double>().head<3>();
  }

  /// What holds an inner vertex that is not on a feature curve.
  [[nodiscard]] VertexHold hold(int i) const;

  bool flip(int a, int b) { return topology_.flip(a, b); }
  bool collapse(int removed, int kept);
  bool split(int a, int b);
  /// Flips edges for as long as that lowers the disorder.
  void mend_valences();

  /// When a relaxation ends.
  struct Relaxation {
    int max_steps;
    double tolerance;  ///< [eV]
    double limit;      ///< given up once the energy is unlikely to come below [eV]
  };
  /// Moves the vertices towards the minimum.
  ///
  /// @return Energy of positions and cores [eV]; nothing if it was given up.
  [[nodiscard]] std::optional<double> relax(const Relaxation& relaxation, Lbfgs<float>& minimizer);

 private:
  using Vector = Lanes<float>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static Vector in_lanes(const Eigen::Vector3d& v) {
    return Eigen::Vector4d(v.x(), v.y(), v.z(), 0.0).cast<float>();
  }
  void find_holds(const MembraneNet& net);
  void find_contacts(const MembraneNet& net, const PointGrid& grid, const PatchMarks& marks);
  /// None where an edge has become too long for the lattice.
  [[nodiscard]] std::optional<MembraneTerms<float>> terms(VertexImages& images) const;
  /// The ends of an edge, and the third corners of its two faces; -1 where there is none.
  using EdgeCorners = std::array<int, 4>;
  /// Of the edge from a to its neighbor k.
  [[nodiscard]] EdgeCorners corners_at(int a, int k) const;
  /// @return  False where an edge has become too long for the lattice.
  bool add_hinge(const EdgeCorners& corners, MembraneTerms<float>& terms,
                 VertexImages& images) const;
  bool add_hinges(MembraneTerms<float>& terms, VertexImages& images) const;
  [[nodiscard]] float rest_length(int a, int b) const;
  [[nodiscard]] Eigen::Vector3d separation(int i, int j) const {
    return (x_[at(j)] - x_[at(i)]).cast<double>().head<3>();
  }
  /// The image of a place that is nearest to a vertex.
  [[nodiscard]] Vector seen_from(int i, const Eigen::Vector3d& place) const;
  [[nodiscard]] Vector beside(int i, const Vector& place) const;
  /// The image of vertex j that is beside vertex i.
  [[nodiscard]] Lattice::Image image_beside(int i, int j) const;
  /// Holds a new vertex of a boundary as its neighbors there are held.
  void hold_between(int n, int a, int b);
  [[nodiscard]] double core_energy() const;
  /// [eV] of the pairs of a vertex that no inner vertex before it counts.
  [[nodiscard]] double pair_energy(int i) const;

  struct Hold {
    Vector foot;
    Vector normal;
  };
  /// Vertices i and an image of j.
  struct NearPair {
    int i;
    int j;
    Lattice::Image image;
  };

  const Membrane* membrane_;
  const Lattice* lattice_;
  PatchTopology topology_;
  Eigen::Vector3d origin_;
  std::vector<Vector> x_;    ///< seen from the origin; vertices of other sheets at the end
  std::vector<Hold> holds_;  ///< of the inner vertices
  std::vector<Tether<float>> feature_tethers_;  ///< that hold vertices to curves and corners
  std::vector<Pull<float>> pulls_;
  std::vector<NearPair> near_;  ///< pairs that may touch, edges included
};

}  // namespace trivalent::remesh
