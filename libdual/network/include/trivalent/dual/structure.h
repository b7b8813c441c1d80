#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::dual {

/// Atoms in order around a ring.
struct Ring {
  std::vector<int> atoms;
  /// Where the ring crosses faces of a periodic box: the cell of each atom, counted from the first
  /// atom's. Empty if all are in one cell.
  std::vector<std::array<std::int32_t, 3>> images = {};
};

/// A named quantity with one value per atom.
struct Column {
  std::string name;  ///< letters, digits, '_', '-' or '.'
  std::variant<std::vector<double>, std::vector<int>, std::vector<Eigen::Vector3d>,
               std::vector<std::array<int, 3>>>
      values;
};

/// A named property of the whole structure.
struct HeaderEntry {
  std::string key;  ///< letters, digits, '_', '-' or '.'
  std::variant<double, std::string> value;
};

/// Atoms and everything known about them: what files, duals, relaxations and pages hold.
///
/// Readers and build_dual fill in what they know; empty bonds or rings are unknown, see
/// add_missing_network.
struct Structure {
  potentials::Atoms atoms = {};
  std::vector<potentials::Bond> bonds = {};  ///< each once, with the periodic image it leads to
  std::vector<Ring> rings = {};
  std::vector<Column> columns = {};
  std::vector<HeaderEntry> header = {};
};

/// Some of the atoms with the bonds and rings between them, in the same order; columns and header
/// stay behind.
[[nodiscard]] Structure part_of(const Structure& structure,
                                const std::function<bool(std::size_t)>& is_kept);

/// Pairs of atoms whose bond stays inside the box.
[[nodiscard]] std::vector<std::array<int, 2>> drawable_bonds(const Structure& structure);

/// Rings that stay inside the box.
[[nodiscard]] std::vector<std::vector<int>> drawable_rings(const Structure& structure);

/// A structure as it is drawn: its atoms and, behind them, the images of atoms to which bonds and
/// rings lead across the faces of a periodic box.
struct Drawing {
  std::vector<Eigen::Vector3d> positions;  ///< of the atoms, then of the images [Å]
  std::vector<int> images;                 ///< atom of each image
  /// The structure's bonds and rings in their order, as places in `positions`.
  std::vector<std::array<int, 2>> bonds;
  std::vector<std::vector<int>> rings;

  [[nodiscard]] int atom(int place) const;  ///< that stands at a place
};

[[nodiscard]] Drawing drawing_of(const Structure& structure);

}  // namespace trivalent::dual
