#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "trivalent/dual/error.h"
#include "trivalent/dual/network.h"
#include "trivalent/formats/digits.h"
#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::dual {

/// A named quantity with one value per atom.
struct Column {
  std::string name;  ///< letters, digits, '_', '-' or '.'
  std::variant<std::vector<double>, std::vector<int>, std::vector<Eigen::Vector3d>,
               std::vector<std::array<int, 3>>>
      values;
};

/// A key=value of the comment line, beside Lattice, Origin, Properties and pbc.
struct HeaderEntry {
  std::string key;  ///< letters, digits, '_', '-' or '.'
  std::variant<double, std::string> value;
};

/// One structure of an extended XYZ file.
struct XyzFrame {
  potentials::Atoms atoms;
  std::vector<Column> columns = {};
  std::vector<HeaderEntry> header = {};
  std::vector<std::string> notes = {};  ///< reading: one sentence per kind of thing left out
};

/// coordination (bonds of every atom) and rings (sizes of the three rings around it, largest first,
/// 0 for a ring that the edge of an open network has cut).
[[nodiscard]] std::vector<Column> network_columns(const Network& network);

/// energies [eV] and forces [eV/Å], under the names by which ASE knows them.
[[nodiscard]] std::vector<Column> energy_columns(const potentials::EnergyForces& result);

/// Writes extended XYZ: Lattice, Properties and pbc, then `species pos` and the columns. Atoms that
/// are periodic in no direction and have no box get a padded one.
///
/// @throws InvalidNetwork if a coordinate is not finite, or species or a column does not have one
/// entry
///   per atom.
/// @throws InvalidOption  if a name is empty, has other characters, or is taken.
void write_xyz(std::ostream& out, const XyzFrame& frame, Digits digits = Digits::ten_decimals);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_xyz(const std::filesystem::path& path, const XyzFrame& frame,
               Digits digits = Digits::ten_decimals);

/// Reads the first structure of an XYZ or extended XYZ file, also compressed with gzip. Columns of
/// text, or of other than 1 or 3 components, are left out and noted, as are further structures.
/// Without pbc a Lattice is periodic in all directions; without Lattice there is no box.
///
/// @throws FileError if the file is missing, unreadable, cut short or malformed, holds a number
/// that is
///   not finite, or elements other than C and H; the message names the line.
[[nodiscard]] XyzFrame read_xyz(const std::filesystem::path& path);

}  // namespace trivalent::dual
