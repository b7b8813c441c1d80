#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/formats/structure_format.h"
#include "trivalent/shell/build.h"

namespace trivalent::shell {

struct BuildFileOptions {
  dual::Digits digits = dual::Digits::ten_decimals;
  dual::AtomStyle atom_style = dual::AtomStyle::atomic;
  /// Names of structure_formats(), in which shell.EXTENSION is written beside extended XYZ.
  std::vector<std::string> formats = {};
};

/// Writes what belongs to the shell itself: surface.off, shell.extxyz, the files of
/// write_lammps_package, energy.ply and energy.vtp, and the shell in further formats.
///
/// @param folder  exists
/// @throws remesh::FileError if a file cannot be written
/// @throws dual::InvalidOption if a format is unknown or can only be read
void write_build(const std::filesystem::path& folder, const BuildResult& result,
                 const BuildFileOptions& options = {});

/// The page around a result.
struct BuildPageOptions {
  std::string title = {};
  std::string program = {};                     ///< who made it, as in "trivalent 0.1.0"
  std::vector<dual::TableRow> parameters = {};  ///< how it was asked for
  std::string_view viewer = {};                 ///< as for dual::write_shell_page
};

/// Writes a page that shows the shell. Takes the result apart: the page gets its states.
///
/// @throws remesh::FileError if the file cannot be written
void write_build_page(const std::filesystem::path& path, BuildResult&& result,
                      const BuildPageOptions& options);

}  // namespace trivalent::shell
