#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trivalent/dual/bonding.h"
#include "trivalent/view/color_scale.h"

namespace trivalent::dual {

/// One of the few values of a map that counts.
struct Category {
  int value = 0;
  std::string label;
  Color color = {};
};

/// A quantity of every atom and how it is colored.
struct AtomMap {
  std::string name;            ///< letters, digits, '_'
  std::string title;           ///< for people
  std::string unit = {};       ///< empty if it has none
  std::vector<double> values;  ///< one per atom; not a number where an atom has none
  ColorScale scale = {};       ///< unless it has categories
  std::vector<Category> categories = {};
  /// Grey where an atom has no value; the nearest category's where it has categories.
  [[nodiscard]] Color color(std::size_t atom) const;
};

/// Colors of counts, also for those who paint rings and not atoms.
[[nodiscard]] std::vector<Category> ring_size_categories();
[[nodiscard]] std::vector<Category> coordination_categories();
[[nodiscard]] Color category_color(std::span<const Category> categories, int value);

/// Energies [eV], white at the reference: what an atom of graphene has under the same potential.
[[nodiscard]] AtomMap energy_map(std::span<const double> energies, double reference);

/// Energies above the reference [eV].
[[nodiscard]] AtomMap excess_map(std::span<const double> energies, double reference);

/// Of the rings at an atom, the size farthest from 6 (the larger of two equally far ones).
[[nodiscard]] AtomMap ring_size_map(const std::vector<std::array<int, 3>>& ring_sizes);

/// Number of bonds.
[[nodiscard]] AtomMap coordination_map(const Bonding& bonding);

/// Mean strain of an atom's bonds from carbon to carbon [%], against bonds of the given length [Å].
[[nodiscard]] AtomMap bond_strain_map(const Bonding& bonding,
                                      std::span<const potentials::Species> species,
                                      double bond_length);

/// Curvature as chemists measure it: the angle [degree] by which the three bonds of an atom lean
/// out of the plane across the axis that has the same angle with all three (POAV1) [Haddon1988]: 0
/// in graphene, 11.6 in C60. Only atoms of three bonds have one.
[[nodiscard]] AtomMap pyramidalization_map(const Bonding& bonding);

/// The wall that an atom belongs to, counted from 1, the innermost.
[[nodiscard]] AtomMap wall_map(std::span<const int> walls);

/// What an atom's energy is lower for by the other walls [eV], < 0 where they attract it.
[[nodiscard]] AtomMap wall_energy_map(std::vector<double> energies);

/// Distances [Å] that were measured elsewhere, from 0: to a surface, or moved.
[[nodiscard]] AtomMap distance_map(std::string name, std::string title,
                                   std::vector<double> distances);

/// How far atoms moved from one state to the other [Å].
///
/// @throws InvalidNetwork if there are not as many.
[[nodiscard]] AtomMap displacement_map(std::span<const Eigen::Vector3d> from,
                                       std::span<const Eigen::Vector3d> to);

}  // namespace trivalent::dual
