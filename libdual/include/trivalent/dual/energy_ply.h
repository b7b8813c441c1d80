#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>

#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/network.h"

namespace trivalent::dual {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A diverging scale: blue below the center, white at it, red above.
struct ColorScale {
  double center = graphene_energy;  ///< white [eV]
  double half_width = 1.0;          ///< from white to full blue or red [eV], > 0
  /// Values beyond the ends take the colors of the ends.
  [[nodiscard]] Color color(double value) const;
};

/// Spans the scale from the 2nd to the 98th percentile of the values, whichever is farther from the
/// center, so that a few bad atoms do not wash out all others.
///
/// @throws InvalidOption if a value or the center is not finite.
[[nodiscard]] ColorScale make_color_scale(std::span<const double> values, double center);

enum class PlyKind { text, binary };

struct EnergyPlyOptions {
  ColorScale scale;
  PlyKind kind = PlyKind::binary;
};

/// Writes an energy map: atoms as vertices with colors and the scalar `energy` [eV], rings as
/// polygons.
///
/// @throws InvalidNetwork if energies are not one per atom, or a coordinate is not finite.
void write_energy_ply(std::ostream& out, const Network& network, std::span<const double> energies,
                      const EnergyPlyOptions& options);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_energy_ply(const std::filesystem::path& path, const Network& network,
                      std::span<const double> energies, const EnergyPlyOptions& options);

}  // namespace trivalent::dual
