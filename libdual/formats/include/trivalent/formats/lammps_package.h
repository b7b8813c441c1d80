#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/lammps_deck.h"

namespace trivalent::dual {

enum class Compression { none, gzip };

struct LammpsPackageOptions {
  LammpsDataOptions data = {};
  std::string name = "shell";  ///< of the data file, without extension
  LammpsPotential potential = LammpsPotential::rebo;
  /// As pair_coeff finds it; if empty, CH.rebo or CH.airebo in LAMMPS's own folder.
  std::optional<std::string> potential_file = {};
  std::optional<PairStyle> pair_style = {};  ///< instead of the potential
  Compression compression = Compression::none;
  std::size_t atoms_per_file = 50'000'000;  ///< >= 1; more atoms go into several files
};

/// What write_lammps_package has written.
struct LammpsPackage {
  std::vector<std::string> files;  ///< in the folder
  Eigen::Matrix3d rotation;        ///< of the atoms, to LAMMPS's frame; see LammpsFrame
};

/// Writes a folder with which LAMMPS can start: the data file (several if there are many atoms),
/// the input scripts in.check, in.relax and in.md (see lammps_deck.h), and a README.md that says
/// how to run them. Atoms whose box LAMMPS does not take are written in its frame (lammps_frame.h);
/// the README says by which rotation.
///
/// @param folder  exists
/// @param energy  of the atoms under the potential [eV], for in.check; not used with another pair
/// style
/// @throws InvalidNetwork, InvalidOption as write_lammps_data and write_lammps_check; InvalidOption
///   also if atoms_per_file is 0, the atoms need several files in molecular style, or there are no
///   bonds for it.
/// @throws FileError if a file cannot be written.
LammpsPackage write_lammps_package(const std::filesystem::path& folder, const Structure& structure,
                                   double energy, const LammpsPackageOptions& options = {});

}  // namespace trivalent::dual
