#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace trivalent::potentials {

/// Chemical element of an atom.
enum class Species : std::uint8_t { carbon, hydrogen };

/// The simulation cell. A cluster in free space has no periodic direction; its cell is then only a
/// frame for file formats and has no influence on energies.
struct Box {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< lower corner [Å]
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();        ///< cell vectors as columns [Å]
  std::array<bool, 3> periodic = {false, false, false};  ///< along each cell vector
  [[nodiscard]] bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  /// A point, or a separation, after a move by so many cell vectors [Å].
  template <typename Integer>
  [[nodiscard]] Eigen::Vector3d shifted(Eigen::Vector3d point,
                                        const std::array<Integer, 3>& image) const {
    for (int k = 0; k < 3; ++k) {
      const Integer count = image[static_cast<std::size_t>(k)];
      if (count != 0) point += count * cell.col(k);
    }
    return point;
  }
  /// Sum of so many cell vectors [Å].
  template <typename Integer>
  [[nodiscard]] Eigen::Vector3d offset(const std::array<Integer, 3>& image) const {
    return shifted(Eigen::Vector3d::Zero(), image);
  }
};

/// Positions and species, one entry per atom, and the box they live in.
struct Atoms {
  std::vector<Eigen::Vector3d> positions;  ///< [Å]
  std::vector<Species> species;            ///< as many as positions
  Box box;
  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// Atoms in memory that someone else owns: what potentials evaluate. Atoms become one by
/// themselves.
struct AtomsView {
  std::span<const Eigen::Vector3d> positions;  ///< [Å]
  std::span<const Species> species;            ///< as many as positions
  Box box = {};
  [[nodiscard]] std::size_t size() const { return positions.size(); }

  AtomsView(std::span<const Eigen::Vector3d> all_positions, std::span<const Species> all_species,
            const Box& its_box)
      : positions(all_positions), species(all_species), box(its_box) {}
  // NOLINTNEXTLINE(google-explicit-constructor): so that whoever has atoms passes them as they are
  AtomsView(const Atoms& atoms) : AtomsView(atoms.positions, atoms.species, atoms.box) {}
};

}  // namespace trivalent::potentials
