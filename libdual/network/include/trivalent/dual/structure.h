#pragma once

#include <Eigen/Core>
#include <array>
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
  bool crosses_boundary = false;  ///< of a periodic box
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

/// Pairs of atoms whose bond stays inside the box: those that can be drawn.
[[nodiscard]] std::vector<std::array<int, 2>> drawable_bonds(const Structure& structure);

/// Rings that stay inside the box.
[[nodiscard]] std::vector<std::vector<int>> drawable_rings(const Structure& structure);

}  // namespace trivalent::dual
