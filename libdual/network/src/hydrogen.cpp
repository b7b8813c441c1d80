#include "trivalent/dual/hydrogen.h"

#include <Eigen/Geometry>
#include <cmath>

#include "trivalent/dual/error.h"
#include "trivalent/dual/network_checks.h"

namespace trivalent::dual {
namespace {

std::vector<std::vector<int>> bonded_atoms(const Network& network) {
  std::vector<std::vector<int>> bonded(coordinations(network).size());
  for (const auto& [first, second] : network.bonds) {
    bonded[static_cast<std::size_t>(first)].push_back(second);
    bonded[static_cast<std::size_t>(second)].push_back(first);
  }
  return bonded;
}

class Capping {
 public:
  explicit Capping(Network& network) : network_(network), bonded_(bonded_atoms(network)) {}

  HydrogenCaps run() {
    HydrogenCaps caps;
    for (std::size_t i = 0; i < bonded_.size(); ++i) {
      const int atom = static_cast<int>(i);
      if (bonded_[i].empty()) ++caps.bare_atoms;
      if (bonded_[i].size() == 1) cap_end(atom);
      if (bonded_[i].size() == 2) cap_edge(atom);
    }
    caps.hydrogens = network_.hydrogens;
    return caps;
  }

 private:
  [[nodiscard]] Eigen::Vector3d direction(int from, int to) const {
    return (network_.positions[static_cast<std::size_t>(to)] -
            network_.positions[static_cast<std::size_t>(from)])
        .normalized();
  }

  void add(int atom, const Eigen::Vector3d& along) {
    const int hydrogen = static_cast<int>(network_.positions.size());
    const Eigen::Vector3d position =
        network_.positions[static_cast<std::size_t>(atom)] + hydrogen_bond_length * along;
    network_.positions.push_back(position);
    network_.bonds.push_back({atom, hydrogen});
    ++network_.hydrogens;
  }

  void cap_edge(int atom) {
    const auto& bonded = bonded_[static_cast<std::size_t>(atom)];
    const Eigen::Vector3d first = direction(atom, bonded[0]);
    const Eigen::Vector3d outward = -(first + direction(atom, bonded[1]));
    // Two bonds in one line leave no outer angle; any direction across will do.
    constexpr double straight = 1e-6;
    add(atom, outward.norm() > straight ? outward.normalized() : first.unitOrthogonal());
  }

  void cap_end(int atom) {
    const int neighbor = bonded_[static_cast<std::size_t>(atom)][0];
    const Eigen::Vector3d bond = direction(atom, neighbor);
    Eigen::Vector3d across = bond.unitOrthogonal();
    for (const int other : bonded_[static_cast<std::size_t>(neighbor)]) {
      // Within the plane of the neighbor's bonds.
      const Eigen::Vector3d away = direction(neighbor, other);
      const Eigen::Vector3d part = away - away.dot(bond) * bond;
      constexpr double straight = 1e-6;
      if (other != atom && part.norm() > straight) across = part.normalized();
    }
    const double sine = 0.5 * std::sqrt(3.0);  // of 120°
    add(atom, -0.5 * bond + sine * across);
    add(atom, -0.5 * bond - sine * across);
  }

  Network& network_;
  std::vector<std::vector<int>> bonded_;
};

}  // namespace

HydrogenCaps cap_with_hydrogen(Network& network) {
  if (network.hydrogens > 0) {
    throw InvalidNetwork(concat("cap_with_hydrogen: the network has ", network.hydrogens,
                                " hydrogen atoms already"));
  }
  return Capping(network).run();
}

}  // namespace trivalent::dual
