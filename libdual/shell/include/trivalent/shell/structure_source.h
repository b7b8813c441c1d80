#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "trivalent/dual/dual_size.h"
#include "trivalent/formats/structure_file.h"

namespace trivalent::shell {

struct StructureOptions {
  dual::DualSize size = dual::MeanBond{};            ///< of the dual, if the file is a mesh
  std::optional<std::array<bool, 3>> periodic = {};  ///< instead of what the file says
};

/// Reads atoms from any format that is known, or a mesh, and takes its dual. Bonds and rings are
/// known for a mesh's dual, and as far as the format has them.
///
/// @throws remesh::FileError, remesh::InvalidMesh, dual::InvalidNetwork if no structure results
/// @throws dual::InvalidOption if the size is out of its range
[[nodiscard]] dual::StructureFile read_structure(const std::filesystem::path& path,
                                                 const StructureOptions& options = {});

}  // namespace trivalent::shell
