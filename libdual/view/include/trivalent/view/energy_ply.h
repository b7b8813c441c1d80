#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>

#include "trivalent/dual/error.h"
#include "trivalent/dual/structure.h"
#include "trivalent/view/color_scale.h"

namespace trivalent::dual {

enum class PlyKind { text, binary };

struct EnergyPlyOptions {
  ColorScale scale;  ///< of the energies [eV]
  PlyKind kind = PlyKind::binary;
};

/// Writes an energy map: atoms as vertices with colors and the scalar `energy` [eV], rings as
/// polygons unless they cross a periodic boundary.
///
/// @throws InvalidNetwork if energies are not one per atom, or a coordinate is not finite.
/// @throws InvalidOption  if the scale has fewer than two colors or no width.
void write_energy_ply(std::ostream& out, const Structure& structure,
                      std::span<const double> energies, const EnergyPlyOptions& options);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_energy_ply(const std::filesystem::path& path, const Structure& structure,
                      std::span<const double> energies, const EnergyPlyOptions& options);

}  // namespace trivalent::dual
