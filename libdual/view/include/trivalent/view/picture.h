#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trivalent/view/shell_state.h"

namespace trivalent::dual {

/// Pixels row by row from the top, three bytes each: red, green, blue.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

enum class PictureStyle {
  atoms,  ///< balls, and sticks where there is room for them
  rings   ///< rings as polygons, each the mean of its atoms (or by its size, if that is the map)
};

/// A dark background.
inline constexpr Color night = {20, 23, 28};

struct PictureOptions {
  int width = 1200;  ///< [pixel], 100 to 10000
  int height = 900;  ///< [pixel], 100 to 10000
  std::string map = "energy";
  PictureStyle style = PictureStyle::atoms;
  double azimuth = -30.0;          ///< turn about the vertical y axis [degree]
  double elevation = 18.0;         ///< then tilt towards the viewer [degree]
  double roll = 0.0;               ///< then turn in the picture [degree]
  double zoom = 1.0;               ///< > 0; 1 fits the whole shell
  std::optional<double> low = {};  ///< ends of the color scale; else the last state's own
  std::optional<double> high = {};
  Color background = {255, 255, 255};
};

/// Draws states side by side, equally large, in the same colors, with their names and a legend.
///
/// Orthographic; shaded balls, sticks and polygons with a little ambient occlusion, nine samples a
/// pixel. Needs no screen. The same input gives the same pixels; text looks as the machine's fonts
/// do.
///
/// @throws InvalidNetwork as check_state, or if there is no state.
/// @throws InvalidOption  if an option is out of its range, or a state has no such map.
///
/// Cost: O(pixels + atoms) time; 150 bytes per pixel.
[[nodiscard]] Picture draw_states(std::span<const ShellState> states,
                                  const PictureOptions& options);

/// Writes a PNG.
///
/// @throws remesh::FileError if it cannot be written.
void write_png(std::ostream& out, const Picture& picture);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace trivalent::dual
