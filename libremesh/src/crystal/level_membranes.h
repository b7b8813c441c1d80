#pragma once

#include "crystal/membrane.h"
#include "crystal/membrane_schedule.h"
#include "trivalent/remesh/crystallize.h"

namespace trivalent::remesh {

/// The membranes of the nets of a surface at every level, and how many faces they should have.
class LevelMembranes {
 public:
  /// @param surface  In Å, where the target length is Membrane::fine_length; not kept.
  LevelMembranes(const TriMesh& surface, const CrystalOptions& options);

  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] bool ends_in_tubes() const { return ends_in_tubes_; }
  /// Vertices of a net of the target length.
  [[nodiscard]] double n_vertices() const;
  /// Faces of a net that comes to those of the target length by divisions.
  [[nodiscard]] int wanted_faces(const Level& level) const;
  /// Vertices of a closed net of the target length.
  [[nodiscard]] int wanted_vertices() const;
  [[nodiscard]] Membrane at(const Level& level) const;
  /// Of the net that is handed out. An open sheet that nothing holds would flatten.
  [[nodiscard]] Membrane last() const;

 private:
  CrystalOptions options_;
  double area_;
  int euler_characteristic_;
  bool is_open_;
  bool is_periodic_;
  bool ends_in_tubes_;
  double tether_factor_;
};

/// What the pairs of a first net will cost once it is divided, beyond what they do now [eV]: the
/// number of heptagons tells several nets apart.
[[nodiscard]] double price_of_pairs(const TriMesh& net, const Level& level);

}  // namespace trivalent::remesh
