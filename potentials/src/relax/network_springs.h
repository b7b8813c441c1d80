#pragma once

#include <span>
#include <vector>

#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/potential.h"

namespace trivalent::potentials::relax_detail {

/// Distances [Å] below which carbon atoms without a bond push each other away, by the number of
/// bonds between them: the two ends of an angle, of a chain of three bonds, and all others. Pairs
/// with hydrogen: shorter, as REBO's reach is.
struct ContactDistances {
  double second = 0.0;
  double third = 0.0;
  double others = 0.0;  ///< the largest
};

/// Lengths at which a bond feels no spring [Å].
struct LengthRange {
  double min;
  double max;
};

/// Stiffness and range of the springs.
struct SpringOptions {
  std::vector<LengthRange> lengths;  ///< one per bond
  double bond_stiffness;             ///< [eV/Å²]
  double smoothness;         ///< of springs from atoms to the mean of their bonded ones [eV/Å²]
  ContactDistances contact;  ///< scaled down where bonds are held shorter than those at rest
  double contact_stiffness;  ///< [eV/Å²]
};

/// Springs on a network: they cannot tear. They draw a rough network towards equal bonds and a
/// smooth surface, or keep bonds within bounds under another potential.
class NetworkSprings : public Potential {
 public:
  NetworkSprings(const AtomsView& atoms, std::span<const Bond> bonds, const SpringOptions& options);

 private:
  using Image = std::array<std::int32_t, 3>;

  struct Spring {
    std::uint32_t atom;
    Image image;
    LengthRange length;
  };

  struct Contact {
    std::uint32_t atom;
    Image image;
    double distance;  // below which the two push each other away [Å]
  };

  /// The result holds no virial.
  void compute(const AtomsView& atoms, EnergyForces& result) override;

  [[nodiscard]] std::span<const Spring> bonded(std::size_t atom) const {
    return std::span(bonded_).subspan(first_bonded_[atom],
                                      first_bonded_[atom + 1] - first_bonded_[atom]);
  }
  void set_scales(const AtomsView& atoms);
  [[nodiscard]] double contact_distance(std::size_t from, std::uint32_t to) const;
  [[nodiscard]] bool is_bonded(std::size_t from, std::uint32_t to, const Image& image) const;
  void find_bends(const AtomsView& atoms);
  void find_contacts(const AtomsView& atoms);
  [[nodiscard]] bool have_moved(const AtomsView& atoms) const;
  [[nodiscard]] double evaluate_atom(const AtomsView& atoms, std::size_t atom,
                                     EnergyForces& result) const;

  SpringOptions options_;
  std::vector<std::size_t> first_bonded_;
  std::vector<Spring> bonded_;  // both directions of every bond, by atom
  std::vector<double> scales_;  // of each atom's contacts, at most 1
  std::vector<std::size_t> first_contact_;
  std::vector<Contact> contacts_;  // pairs that may come into contact, likewise
  std::vector<Eigen::Vector3d> positions_of_contacts_;
  std::vector<Eigen::Vector3d> bends_;  // from each atom to the mean of its bonded ones
};

}  // namespace trivalent::potentials::relax_detail
