#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "rebo/angular_function.h"
#include "rebo/bond_list.h"
#include "rebo/candidates.h"
#include "rebo/parameters.h"
#include "rebo/regular_kernel.h"

namespace trivalent::potentials::rebo_detail {

/// What evaluating an atom reads. All arrays are numbered as Candidates is.
struct Surroundings {
  const Parameters& parameters;
  const Candidates& candidates;
  const double* positions;            ///< four per point [Å], the last one unused
  const Coordination* coordinations;  ///< per atom; only of irregular ones
  const std::uint8_t* states;         ///< per atom, see AtomState

  [[nodiscard]] Eigen::Vector3d position(std::uint32_t point) const {
    return Eigen::Vector3d::Map(positions + std::size_t{4} * point);
  }
  /// From the atom to the end of its link [Å]; exactly the opposite from the other end, so that
  /// both always agree on whether there is a bond.
  [[nodiscard]] Eigen::Vector3d separation(std::uint32_t atom, std::uint32_t link) const;
  [[nodiscard]] Coordination coordination(std::uint32_t atom) const;
};

inline Eigen::Vector3d Surroundings::separation(std::uint32_t atom, std::uint32_t link) const {
  const std::uint32_t point = candidates.point[link];
  if (point < candidates.count()) return position(point) - position(atom);
  // Images are rounded: the difference to an image is taken from the same end always.
  const std::uint32_t back = candidates.reverse[link];
  if (link < back) return position(point) - position(atom);
  return position(candidates.home(point)) - position(candidates.point[back]);
}

/// What evaluating an atom writes: only at the atom itself and at its own links.
struct Slopes {
  double* links;             ///< four per link: dE/d(separation) [eV/Å], energy for the other end
  double* energies;          ///< per atom, own share [eV]
  std::uint32_t first_link;  ///< what links begins with
  std::uint32_t first_atom;  ///< what energies begins with
  double* cutoffs;           ///< per link, dE/df [eV]
  double* others;            ///< per link, dE/dN of the atom at its end [eV]
  Coordination* coordination;  ///< per atom, dE/dN [eV]
};

/// Evaluates REBO around one atom at a time, whatever its neighbors are.
///
/// The terms are those of BondOrder, cut in another way: an atom takes the derivatives of its own
/// p, its own coordination and its own planes, for all of its bonds; the atom at the other end does
/// the same. So no two atoms write to the same place, and sums do not depend on threads.
class IrregularAtom {
 public:
  /// @param atoms  how many from slopes.first_atom on are to be evaluated; others may be neighbors
  IrregularAtom(const Surroundings& surroundings, const Slopes& slopes, std::uint32_t atoms)
      : in_(surroundings), out_(slopes), known_(atoms, unknown) {}

  /// Writes everything in Slopes for one atom.
  void evaluate(std::uint32_t atom);

  /// Adds to a regular atom what the kernel leaves out: π and T D of bonds that are not conjugated.
  void add_other_pi(std::uint32_t atom);

  /// What the slopes of all atoms up to now add to the virial [eV]; symmetric only over all atoms.
  [[nodiscard]] const Eigen::Matrix3d& virial() const { return virial_; }

 private:
  static constexpr std::uint32_t unknown = 0xffffffff;

  // A bond as it is seen from one end.
  struct Neighbor {
    std::uint32_t link;
    std::uint32_t atom;
    Species species;
    Eigen::Vector3d separation;
    Eigen::Vector3d direction;
    double r;
    ValueAndSlope f;           // cutoff
    ValueAndSlope f_dihedral;  // cutoff of the dihedral term
    ValueAndSlope F;           // conjugation; of carbon neighbors only, else zero
  };

  // Derivatives of the energy with respect to a bond of the atom that is evaluated.
  struct NeighborSlopes {
    Eigen::Vector3d separation = Eigen::Vector3d::Zero();  // except through f
    double f = 0.0;
    double X = 0.0;    // through F
    double due = 0.0;  // energy for the atom at the other end
  };

  // An atom and its bonds, kept for as long as its neighbors may ask for them.
  struct Center {
    std::uint32_t atom;
    Species species;
    Coordination coordination;
    double conjugation;  // Σ f F
    std::uint32_t first;
    std::uint32_t count;
  };

  // Between two bonds of the atom that is evaluated.
  struct Angle {
    double cosine;
    AngularShapes g;
    double slope;  // of the energy, d/d cosine
  };

  struct Plane {
    std::size_t neighbor;
    Eigen::Vector3d normal;
    double inverse_square;
    double share;  // f' s
    double cosine;
    ValueAndSlope bent;
  };

  [[nodiscard]] std::uint32_t find(std::uint32_t atom);
  [[nodiscard]] Center load(std::uint32_t atom);
  [[nodiscard]] std::span<const Neighbor> neighbors(const Center& center) const {
    return std::span(neighbors_).subspan(center.first, center.count);
  }
  template <typename Condition>
  void start(std::uint32_t atom, const Condition& is_needed);
  void find_angles();
  [[nodiscard]] Angle& angle(std::size_t j, std::size_t k) {
    const auto [low, high] = std::minmax(j, k);
    return angles_[high * (high - 1) / 2 + low];
  }
  [[nodiscard]] double stretch_factor(std::size_t j, std::size_t k) const;
  void add_slopes_of_angles();
  void evaluate_bond(std::size_t j);
  void evaluate_pi(std::size_t j);
  [[nodiscard]] double add_sigma(std::size_t j, double attracted);
  [[nodiscard]] double add_pi(std::size_t j, double weight);
  [[nodiscard]] double add_dihedral(std::size_t j, std::size_t back, double weight);
  void add_slope_of_cosine(std::size_t j, std::size_t k, double cosine, double slope);
  void add_coordination_without(std::size_t j, Coordination slope);
  static void find_planes(std::span<const Neighbor> neighbors, std::size_t axis,
                          std::vector<Plane>& planes);
  void clear_links() const;
  void write();

  Surroundings in_;
  Slopes out_;
  std::vector<std::uint32_t> known_;  // index of the center of each atom of the tile, if loaded
  std::vector<Center> centers_;
  std::vector<Neighbor> neighbors_;  // of all centers
  // Of the atom that is evaluated:
  Center near_{};
  std::span<const Neighbor> near_neighbors_;
  std::vector<NeighborSlopes> slopes_;
  std::vector<std::uint32_t> far_;  // centers of its neighbors, where needed
  double energy_ = 0.0;
  Eigen::Matrix3d virial_ = Eigen::Matrix3d::Zero();
  Coordination slope_coordination_;
  std::vector<Angle> angles_;
  std::vector<double> factors_;  // exp λ of the angles of one bond
  std::vector<Plane> near_planes_;
  std::vector<Plane> far_planes_;
};

}  // namespace trivalent::potentials::rebo_detail
