#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "trivalent/dual/error.h"
#include "trivalent/dual/structure.h"
#include "trivalent/formats/digits.h"
#include "trivalent/formats/structure_file.h"

namespace trivalent::dual {

/// LAMMPS's atom_style: which columns the section Atoms of a data file has.
enum class AtomStyle {
  atomic,     ///< id type x y z
  charge,     ///< id type charge x y z; read only
  molecular,  ///< id molecule type x y z, and a section Bonds; also LAMMPS's bond and angle
  full        ///< id molecule type charge x y z; read only
};

/// What a file of atoms may leave open.
struct ReadOptions {
  /// Elements of LAMMPS's types 1, 2, ...; if empty, the file must tell them.
  std::vector<potentials::Species> elements = {};
  std::optional<int> frame = {};  ///< which of several structures, from 1; if none, the last
  std::optional<AtomStyle> atom_style = {};  ///< of LAMMPS data; if none, as the file says
};

struct WriteOptions {
  Digits digits = Digits::ten_decimals;
  AtomStyle atom_style = AtomStyle::atomic;  ///< of LAMMPS data
  /// Of CIF: atoms may be this far from places of a space group [Å]; if none, all are written.
  std::optional<double> symmetry_tolerance = {};
};

/// A format of files of atoms.
struct StructureFormat {
  std::string name;
  std::vector<std::string> extensions;     ///< in lower case, with the dot
  std::vector<std::string> prefixes = {};  ///< beginnings of file names, as in data.NAME
  /// @throws FileError if the file is missing or not of this format; the message names the line.
  StructureFile (*read)(const std::filesystem::path& path, const ReadOptions& options) = nullptr;
  /// @return  Notes on what the format changes; usually none.
  /// @throws InvalidNetwork, InvalidOption if the format cannot hold the structure.
  std::vector<std::string> (*write)(std::ostream& out, const Structure& structure,
                                    const WriteOptions& options) = nullptr;
  bool holds_selective_dynamics = false;  ///< write() keeps the column of that name
};

/// The formats that are known. A program may add its own before it reads or writes anything.
[[nodiscard]] std::vector<StructureFormat>& structure_formats();

/// The format of this name.
///
/// @throws InvalidOption if there is none; the message lists them.
[[nodiscard]] const StructureFormat& structure_format(const std::string& name);

/// The format that a file's name asks for, compressed (.gz) or not; none if no format has it.
[[nodiscard]] const StructureFormat* find_structure_format(const std::filesystem::path& path);

/// All extensions of all formats that can be written.
[[nodiscard]] std::vector<std::string> structure_extensions();

/// Writes a file in the format that its name asks for, compressed if it ends in .gz. The file
/// appears whole or not at all.
///
/// @return  The notes of the format's write(), and that flags of selective dynamics are lost.
/// @throws InvalidOption  if no format has the name.
/// @throws FileError      if the file cannot be written.
/// @throws what the format's write() throws.
std::vector<std::string> write_structure(const std::filesystem::path& path,
                                         const Structure& structure,
                                         const WriteOptions& options = {});

}  // namespace trivalent::dual
