#include "trivalent/dual/hydrogen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trivalent/dual/bonding.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

class Capping {
 public:
  explicit Capping(Structure& structure) : structure_(structure), bonding_(bonding_of(structure)) {}

  HydrogenCaps run() {
    HydrogenCaps caps;
    const std::size_t n_carbon = structure_.atoms.size();
    for (std::uint32_t atom = 0; atom < n_carbon; ++atom) {
      if (bonding_[atom].empty()) ++caps.bare_atoms;
      if (bonding_[atom].size() == 1) cap_end(atom);
      if (bonding_[atom].size() == 2) cap_edge(atom);
    }
    caps.hydrogens = static_cast<int>(structure_.atoms.size() - n_carbon);
    return caps;
  }

 private:
  void add(std::uint32_t atom, const Eigen::Vector3d& along) {
    potentials::Atoms& atoms = structure_.atoms;
    const auto hydrogen = static_cast<std::uint32_t>(atoms.size());
    const Eigen::Vector3d position = atoms.positions[atom] + hydrogen_bond_length * along;
    atoms.positions.push_back(position);
    atoms.species.push_back(potentials::Species::hydrogen);
    structure_.bonds.push_back({atom, hydrogen});
  }

  void cap_edge(std::uint32_t atom) {
    const auto& ends = bonding_[atom];
    const Eigen::Vector3d first = ends[0].separation.normalized();
    const Eigen::Vector3d outward = -(first + ends[1].separation.normalized());
    // Two bonds in one line leave no outer angle; any direction across will do.
    constexpr double straight = 1e-6;
    add(atom, outward.norm() > straight ? outward.normalized() : first.unitOrthogonal());
  }

  void cap_end(std::uint32_t atom) {
    const BondEnd& neighbor = bonding_[atom][0];
    const Eigen::Vector3d bond = neighbor.separation.normalized();
    Eigen::Vector3d across = bond.unitOrthogonal();
    for (const BondEnd& other : bonding_[static_cast<std::size_t>(neighbor.atom)]) {
      // Within the plane of the neighbor's bonds.
      const Eigen::Vector3d away = other.separation.normalized();
      const Eigen::Vector3d part = away - away.dot(bond) * bond;
      constexpr double straight = 1e-6;
      const bool is_way_back = other.atom == static_cast<int>(atom);
      if (!is_way_back && part.norm() > straight) across = part.normalized();
    }
    const double sine = 0.5 * std::sqrt(3.0);  // of 120°
    add(atom, -0.5 * bond + sine * across);
    add(atom, -0.5 * bond - sine * across);
  }

  Structure& structure_;
  Bonding bonding_;
};

}  // namespace

HydrogenCaps cap_with_hydrogen(Structure& structure) {
  if (has_hydrogen(structure.atoms)) {
    const auto hydrogens =
        std::ranges::count(structure.atoms.species, potentials::Species::hydrogen);
    throw InvalidNetwork(
        concat("cap_with_hydrogen: the network has ", hydrogens, " hydrogen atoms already"));
  }
  return Capping(structure).run();
}

Structure without_hydrogen(const Structure& structure) {
  return part_of(structure, [&](std::size_t atom) {
    return structure.atoms.species[atom] == potentials::Species::carbon;
  });
}

}  // namespace trivalent::dual
