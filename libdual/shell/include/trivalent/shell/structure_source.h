#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "trivalent/dual/dual_size.h"
#include "trivalent/formats/structure_format.h"

namespace trivalent::shell {

struct StructureOptions {
  /// Of the dual, if the file is a mesh; if none, dual::MeanBond.
  std::optional<dual::DualSize> size = {};
  std::optional<std::array<bool, 3>> periodic = {};  ///< instead of what the file says
  std::optional<std::string> format = {};            ///< a name of structure_formats()
  dual::ReadOptions reading = {};                    ///< if the file is none of a mesh
};

/// Reads atoms from any of structure_formats(), makes one of ideal_structures()
/// ("nanotube:n=10,m=5"), or reads a mesh and takes its dual. The file's name says which, unless
/// the format is given; standard input ("-") needs one. Bonds and rings are known for the dual of a
/// mesh, and as far as the format has them.
///
/// @throws remesh::FileError, remesh::InvalidMesh, dual::InvalidNetwork if no structure results
/// @throws dual::InvalidOption if the size is out of its range, the format is unknown or missing,
/// or
///   options for reading atoms are given for a mesh
[[nodiscard]] dual::StructureFile read_structure(const std::filesystem::path& path,
                                                 const StructureOptions& options = {});

}  // namespace trivalent::shell
