#pragma once

#include <optional>
#include <span>
#include <vector>

#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// Below which distances [Å] atoms without a bond push each other away, by the number of bonds
/// between them: the two ends of an angle, of a chain of three bonds, and all others.
struct ContactDistances {
  double second = 0.0;
  double third = 0.0;
  double others = 0.0;  ///< the largest
};

/// Stiffness and range of the springs.
struct SpringOptions {
  double bond_stiffness;  ///< [eV/Å²]
  double shortest;        ///< bonds between this and `longest` feel no spring [Å]
  double longest;         ///< [Å]
  double smoothness;      ///< of springs from atoms to the mean of their bonded ones [eV/Å²]
  ContactDistances contact;
  double contact_stiffness;  ///< [eV/Å²]
  /// Length at rest of every bond [Å], instead of `shortest` and `longest`. Where bonds are shorter
  /// than carbon's, contacts are so too.
  std::vector<double> rest_lengths = {};
};

/// Springs on a network: they cannot tear. They draw a rough network towards equal bonds and a
/// smooth surface, or keep bonds within bounds under another potential.
class NetworkSprings : public Potential {
 public:
  NetworkSprings(const Atoms& atoms, std::span<const Bond> bonds, const SpringOptions& options);

 private:
  /// The result holds no virial.
  void compute(const Atoms& atoms, EnergyForces& result) override;

  struct Link {
    std::uint32_t atom;
    std::array<std::int32_t, 3> image;
    double length;  // of a bond at rest, or of a contact [Å]
    [[nodiscard]] bool leads_to(const Link& other) const {
      return atom == other.atom && image == other.image;
    }
  };

  [[nodiscard]] std::span<const Link> bonded(std::size_t atom) const {
    return std::span(bonded_).subspan(first_bonded_[atom],
                                      first_bonded_[atom + 1] - first_bonded_[atom]);
  }
  [[nodiscard]] Eigen::Vector3d separation(const Atoms& atoms, std::size_t atom,
                                           const Link& link) const;
  /// By how much a bond is longer (> 0) or shorter than its spring [Å].
  [[nodiscard]] double excess(const Atoms& atoms, std::size_t atom, const Link& link,
                              double length) const;
  void set_scales();
  [[nodiscard]] double contact_distance(std::size_t from, std::uint32_t to) const;
  void find_bends(const Atoms& atoms);
  void find_contacts(const Atoms& atoms);
  [[nodiscard]] bool have_moved(const Atoms& atoms) const;
  [[nodiscard]] double evaluate_atom(const Atoms& atoms, std::size_t atom,
                                     EnergyForces& result) const;
  [[nodiscard]] double add_spring(const Eigen::Vector3d& between, double excess, double stiffness,
                                  Eigen::Vector3d& force) const;

  SpringOptions options_;
  std::vector<std::size_t> first_bonded_;
  std::vector<Link> bonded_;    // both directions of every bond, by atom
  std::vector<double> scales_;  // of each atom's contacts, at most 1
  std::vector<std::size_t> first_contact_;
  std::vector<Link> contacts_;  // pairs that may come into contact, likewise
  std::vector<Eigen::Vector3d> positions_of_contacts_;
  std::vector<Eigen::Vector3d> bends_;  // from each atom to the mean of its bonded ones
};

}  // namespace trivalent::potentials::relax_detail
